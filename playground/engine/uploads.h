#pragma once

#include "playground/engine/log_link.h"
#include "playground/engine/request.h"
#include "uploader/upload.h"

#include <optional>
#include <string>
#include <vector>

namespace orb::playground {

/// What a page must know to open links to robots and to write to them.
Answer links(Request& request);

/// An upload over a link that only answers later: uploader::deliver() runs from its beginning on
/// what the link has done so far, and where that ends stands what the link shall do next. The very
/// same C++ decides as for any other link.
class Upload {
public:
  static tl::expected<Upload, Problem> start(Request& request);

  /// Takes what came of the last wish; returns the next one, or how the upload ended.
  std::string step(const ordered_json& done);

private:
  std::string next();

  uploader::Delivery delivery_;
  uploader::BatteryPolicy battery_ = uploader::BatteryPolicy::Refuse;
  uploader::Budgets budgets_;
  std::uint8_t first_seq_ = 0;
  std::vector<Done> log_;
};

} // namespace orb::playground
