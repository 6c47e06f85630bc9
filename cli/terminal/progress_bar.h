#pragma once

#include "cli/context/context.h"
#include "uploader/upload.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace orb::cli {

/// Shows how an upload goes on, on stderr: a bar that is drawn over itself on a terminal, a line
/// now and then elsewhere, nothing with -q.
class ProgressBar final : public uploader::Progress {
public:
  explicit ProgressBar(const Context& context);
  ~ProgressBar() override;
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void on_item(std::string_view name) override;
  void on_status(const uploader::Status& status, Instant now) override;

  /// Takes the bar off the screen, so that something else can be printed.
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

/// The same for things that are counted: drawn on a terminal a few times a second, else nothing.
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

/// Whether stderr is a terminal on which a line can be drawn over itself.
bool can_animate();

/// `[#####---------------]`: how much of it is sent.
std::string progress_bar(const uploader::Status& status);

/// The numbers and what is left, without the name and the bar.
std::string describe_progress(const uploader::Status& status, Duration sending_for);

} // namespace orb::cli
