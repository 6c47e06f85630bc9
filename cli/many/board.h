#pragma once

#include "cli/context/context.h"
#include "cli/many/roster.h"
#include "uploader/upload.h"

#include <chrono>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::cli {

/// Shows several robots at once on stderr: on a terminal a row for each robot in progress, updated
/// in place; elsewhere a line for each finished one. Output of the robots' programs goes to stdout,
/// with the robot's name before each line. Thread-safe.
class Board {
public:
  Board(const Context& context, const std::vector<RosterMember>& members);
  ~Board();
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;

  /// Sets a robot's current step; an empty text removes its row.
  void show(std::size_t robot, std::string_view text);
  /// Prints a line for people: `red: MESSAGE`.
  void note(std::size_t robot, std::string_view message);
  /// Prints a line from a robot's program.
  void print(std::size_t robot, std::string_view line);

private:
  void clear();
  void draw();
  std::string row(std::size_t robot, std::size_t columns) const;

  const Context& context_;
  const std::vector<RosterMember>& members_;
  bool animated_;
  std::size_t name_width_ = 0;
  std::mutex mutex_;
  std::vector<std::string> texts_; ///< for each robot; empty without a row
  std::size_t drawn_ = 0;          ///< rows on the screen
  std::chrono::steady_clock::time_point drawn_at_{};
};

/// The board's row for one robot: shows its upload and connection steps, and keeps its verdict.
class Row final : public uploader::Progress {
public:
  Row(Board& board, std::size_t robot) : board_(board), robot_(robot) {}

  void on_item(std::string_view name) override;
  void on_status(const uploader::Status& status, Instant now) override;
  void on_step(protocol::BleStep step, const tl::expected<std::string, uploader::BleError>& found);

  /// How it ended, as a sentence, if its last error does not say it.
  void set_verdict(std::string verdict) { verdict_ = std::move(verdict); }
  const std::string& verdict() const { return verdict_; }
  /// Signal strength such as `-55 dBm`; empty if unknown.
  const std::string& signal() const { return signal_; }

private:
  Board& board_;
  std::size_t robot_;
  std::string item_;
  std::string verdict_;
  std::string signal_;
  std::optional<Instant> sending_since_;
};

} // namespace orb::cli
