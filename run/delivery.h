#pragma once

#include "base/exit_code.h"
#include "run/input.h"
#include "uploader/upload.h"

#include <cstdint>
#include <optional>
#include <span>
#include <tl/expected.hpp>

namespace orb::run {

/// How things are delivered to a ball.
struct DeliveryOptions {
  spec::Area area = spec::Area::Ram; ///< for the program
  bool run = false;
  std::optional<std::uint16_t> line;       ///< start line; default: the first
  std::optional<uploader::MacroKind> kind; ///< for all macros; default: what each file says
  std::optional<std::uint8_t> id;          ///< replaces the id of a user macro
  bool clear_macros = false;               ///< first erase the ball's own macros
};

/// Puts inputs into delivery order: macros first, then the program. Refuses what one ball cannot
/// hold.
tl::expected<uploader::Delivery, Failure> arrange(std::span<const Input> inputs,
                                                  const DeliveryOptions& options);

} // namespace orb::run
