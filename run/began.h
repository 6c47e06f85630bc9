#pragma once

#include "protocol/packet.h"
#include "run/line_map.h"
#include "uploader/upload.h"

#include <cstdint>
#include <optional>
#include <string>

namespace orb::run {

/// A fault that a ball reports: the line, and a number that may be missing from the robot's table.
struct ReportedFault {
  std::uint16_t line = 0;
  std::uint16_t code = 0;
};

std::optional<ReportedFault> fault_in(const protocol::Async& message);

/// How a program started on a ball has begun.
struct Began {
  std::string words = "started"; ///< or what happened instead
  std::optional<ReportedFault> fault = std::nullopt;
  std::optional<uploader::NoAnswer> unheard = std::nullopt; ///< why waiting ended early
};

/// Waits at most a second (Budgets::start_sign) for the first print or error of a program that was
/// just started. After an error stops the wheels, which would keep turning.
Began watch_start(uploader::Session& session, const LineMap& lines);

} // namespace orb::run
