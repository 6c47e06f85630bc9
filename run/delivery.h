#pragma once

#include "base/exit_code.h"
#include "run/input.h"
#include "uploader/upload.h"

#include <cstdint>
#include <optional>
#include <span>
#include <tl/expected.hpp>

namespace orb::run {

/// What is to become of the things that are brought to a ball.
struct DeliveryOptions {
  spec::Area area = spec::Area::Ram; ///< of the program
  bool run = false;
  std::optional<std::uint16_t> line;       ///< where the program starts; else its first
  std::optional<uploader::MacroKind> kind; ///< of all macros; else what each file says
  std::optional<std::uint8_t> id;          ///< of a user macro, in place of the file's
  bool clear_macros = false;               ///< the ball forgets its own first
};

/// Puts what users hand in into the order in which it goes: macros first, then the program. Refuses
/// what one ball cannot hold.
tl::expected<uploader::Delivery, Failure> arrange(std::span<const Input> inputs,
                                                  const DeliveryOptions& options);

} // namespace orb::run
