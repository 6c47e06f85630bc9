#pragma once

#include "base/io_error.h"
#include "cli/run/run_console.h"
#include "run/room.h"
#include "run/trace.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace orb::cli {

/// Prints the output of a room's programs with the ball's name before each line, or one trace of
/// all of them, ordered by time and then by name.
class RoomConsole {
public:
  RoomConsole(const RunOptions& options, std::vector<const run::RoomBall*> balls);
  ~RoomConsole();

  /// The listener of a ball, by its index.
  run::Listener& ear(std::size_t ball);

  /// `endings` are in the order of the balls.
  tl::expected<void, IoError> finish(const std::vector<run::Ending>& endings);

private:
  class Ear;
  enum class From : std::uint8_t { Program, Trace };
  struct PendingLine {
    Duration t;
    std::size_t rank = 0; ///< position of the ball by name
    std::string text;
    From from = From::Program;
  };
  void tell(Duration t, std::size_t rank, std::string text, From from);
  void flush();
  void put(const PendingLine& line);

  const RunOptions& options_;
  std::optional<report::TraceFormat> format_;
  bool prints_;
  std::vector<std::unique_ptr<Ear>> ears_;
  std::vector<PendingLine> waiting_; ///< until all balls have reached that time
  std::string text_;                 ///< of a trace that goes to a file
};

} // namespace orb::cli
