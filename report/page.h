#pragma once

#include "report/journey.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace orb::report {

/// One self-contained page that plays the run back: no network, no other file. `title` stands on
/// top; `before`, from run_of_page(), is a run to show beside it; `keywords` are the words that
/// `.orb` sources have besides the robot's. The same journey makes the same bytes.
std::string report_page(const Journey& journey, std::string_view title,
                        std::string_view before = {},
                        std::span<const std::string_view> keywords = {});

/// The same for all balls of a room, in one page.
std::string room_page(std::span<const RoomRun> balls, std::string_view title,
                      std::span<const std::string_view> keywords = {});

/// What such a page plays back, as JSON of schema `orb.report/1` that may stand in a script.
std::string run_json(const Journey& journey, std::string_view title,
                     std::span<const std::string_view> keywords = {});

/// How much of a run that goes on is shown already.
struct Shown {
  Duration until = -Duration{1};
  std::uint64_t happenings = 0;
};

/// What has come to a run since `shown`, which is brought up to date: rows of the columns and the
/// events of run_json(), as plain values, for whoever shows the run while it goes on. A column that
/// has become too long is thinned in run_json() only.
std::string growth_json(const Journey& journey, Shown& shown);

/// The run that a page of report_page() plays back; nothing where `page` is something else.
std::optional<std::string> run_of_page(std::string_view page);

} // namespace orb::report
