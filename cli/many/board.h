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

/// Shows several robots at once on stderr: on a terminal a row for each that is being worked with,
/// drawn over itself; elsewhere a line for each that is done. What the robots' programs print goes
/// to stdout, each line with the robot's name. For several threads.
class Board {
public:
  Board(const Context& context, const std::vector<Member>& members);
  ~Board();
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;

  /// What a robot is at from now on; an empty text takes its row off.
  void show(std::size_t robot, std::string_view text);
  /// A line for people: `red: MESSAGE`.
  void note(std::size_t robot, std::string_view message);
  /// A line that a robot's program has printed.
  void print(std::size_t robot, std::string_view line);

private:
  void clear();
  void draw();
  std::string row(std::size_t robot, std::size_t columns) const;

  const Context& context_;
  const std::vector<Member>& members_;
  bool animated_;
  std::size_t name_width_ = 0;
  std::mutex mutex_;
  std::vector<std::string> texts_; ///< of each robot; empty without a row
  std::size_t drawn_ = 0;          ///< rows on the screen
  std::chrono::steady_clock::time_point drawn_at_{};
};

/// One of the robots on the board: hears of its upload and of the steps to it, and remembers its
/// verdict.
class Row final : public uploader::Progress {
public:
  Row(Board& board, std::size_t robot) : board_(board), robot_(robot) {}

  void on_item(std::string_view name) override;
  void on_status(const uploader::Status& status, Instant now) override;
  void on_step(protocol::BleStep step, const tl::expected<std::string, uploader::BleError>& found);

  /// How it ended, in a sentence, where that is not what its last error says.
  void set_verdict(std::string verdict) { verdict_ = std::move(verdict); }
  const std::string& verdict() const { return verdict_; }
  /// How strongly it was received, as in `-55 dBm`; empty where nothing says it.
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
