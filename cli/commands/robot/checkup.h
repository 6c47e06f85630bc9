#pragma once

#include "cli/context/context.h"
#include "cli/context/json.h"
#include "uploader/endpoint.h"

#include <fmt/format.h>
#include <string_view>

namespace orb::cli {

/// Prints one finding per line, or collects them for one JSON document. Remembers if one was bad.
class Checkup {
public:
  Checkup(const Context& context, Json* json) : style_(context.out_style()), json_(json) {}

  void good(std::string_view text) {
    if (json_ != nullptr)
      json_->push_back({{"ok", true}, {"text", text}});
    else
      print_out(fmt::format("{}    {}\n", style_.paint(Role::Good, "ok"), text));
  }
  /// Reports a problem and the command or action that helps.
  void bad(std::string_view text, std::string_view remedy) {
    healthy_ = false;
    if (json_ != nullptr)
      json_->push_back({{"ok", false}, {"text", text}, {"remedy", remedy}});
    else
      print_out(fmt::format("{} {}\n      {}\n", style_.paint(Role::Error, "wrong"), text, remedy));
  }
  bool healthy() const { return healthy_; }

private:
  Style style_;
  Json* json_; ///< null if findings are printed at once
  bool healthy_ = true;
};

/// Checks for classic Bluetooth on this computer.
void check_bluetooth(Checkup& checkup);

/// Returns true if a device exists and may be opened; does not open it.
bool check_node(Checkup& checkup, const uploader::Endpoint& endpoint);

} // namespace orb::cli
