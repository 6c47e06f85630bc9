#pragma once

#include "report/journey.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace orb::report {

/// Returns one self-contained page that plays the run back: no network, no other file. `title` is
/// the heading; `before`, from run_of_page(), is a run to show beside it; `keywords` are the words
/// of `.orb` sources beyond the robot's. The same journey gives the same bytes.
std::string report_page(const Journey& journey, std::string_view title,
                        std::string_view before = {},
                        std::span<const std::string_view> keywords = {});

/// Returns such a page for all balls of a room.
std::string room_page(std::span<const RoomRun> balls, std::string_view title,
                      std::span<const std::string_view> keywords = {});

/// Returns the data of such a page: JSON of schema `orb.report/1`, safe inside a script element.
std::string run_json(const Journey& journey, std::string_view title,
                     std::span<const std::string_view> keywords = {});

/// The part of a running run that is already shown.
struct Shown {
  Duration until = -Duration{1};
  std::uint64_t happenings = 0;
};

/// Returns what was added since `shown`, and updates `shown`: new column rows and events of
/// run_json(), as plain values. Used to show a run live. Only run_json() thins columns that have
/// become too long.
std::string growth_json(const Journey& journey, Shown& shown);

/// Extracts the run from a page made by report_page(); nullopt for any other text.
std::optional<std::string> run_of_page(std::string_view page);

} // namespace orb::report
