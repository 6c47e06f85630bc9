#pragma once

#include "cli/context/context.h"
#include "cli/context/json.h"
#include "uploader/endpoint.h"

#include <fmt/format.h>
#include <string_view>

namespace orb::cli {

/// Prints one finding a line, or gathers them for one JSON document, and knows whether one was bad.
class Checkup {
public:
  Checkup(const Context& context, Json* json) : style_(context.out_style()), json_(json) {}

  void good(std::string_view text) {
    if (json_ != nullptr)
      json_->push_back({{"ok", true}, {"text", text}});
    else
      print_out(fmt::format("{}    {}\n", style_.paint(Role::Good, "ok"), text));
  }
  /// What is wrong, and the command or act that helps.
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
  Json* json_; ///< null where the findings are printed as they come
  bool healthy_ = true;
};

/// Whether this computer has classic Bluetooth.
void check_bluetooth(Checkup& checkup);

/// Whether a device is there and may be opened; it is not opened here.
bool check_node(Checkup& checkup, const uploader::Endpoint& endpoint);

} // namespace orb::cli
