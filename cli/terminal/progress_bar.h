#pragma once

#include "cli/context/context.h"
#include "uploader/upload.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace orb::cli {

/// Shows the progress of an upload on stderr: on a terminal a bar updated in place, elsewhere an
/// occasional line, nothing with -q.
class ProgressBar final : public uploader::Progress {
public:
  explicit ProgressBar(const Context& context);
  ~ProgressBar() override;
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void on_item(std::string_view name) override;
  void on_status(const uploader::Status& status, Instant now) override;

  /// Removes the bar, so that something else can be printed.
  void clear();

private:
  void draw(const uploader::Status& status, Instant now);
  void print_line(const uploader::Status& status, Instant now);

  bool quiet_;
  bool animated_;
  bool drawn_ = false;
  std::string name_;
  std::optional<Instant> sending_since_;
  int attempt_ = 1;
  int told_quarter_ = 0;
};

/// The same for countable things: updated a few times a second on a terminal, nothing elsewhere.
class CountBar {
public:
  CountBar(const Context& context, std::string_view noun);
  ~CountBar();
  CountBar(const CountBar&) = delete;
  CountBar& operator=(const CountBar&) = delete;

  void show(std::uint64_t done, std::uint64_t all);

private:
  std::string noun_;
  bool animated_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point drawn_at_ = start_;
};

/// True if stderr is a terminal whose line can be updated in place.
bool can_animate();

/// `[#####---------------]`: the share sent.
std::string progress_bar(const uploader::Status& status);

/// The numbers and the remaining time, without name and bar.
std::string describe_progress(const uploader::Status& status, Duration sending_for);

} // namespace orb::cli
