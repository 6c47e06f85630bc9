#pragma once

#include "base/io_error.h"
#include "cli/run/run_console.h"
#include "run/room.h"
#include "run/trace.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace orb::cli {

/// Prints what the programs of a room print, each line with the name of its ball, or one trace of
/// all of them: in the order of time, and what happens at one time in the order of names.
class RoomConsole {
public:
  RoomConsole(const RunOptions& options, std::vector<const run::RoomBall*> balls);
  ~RoomConsole();

  /// The listener of a ball, by its place among the balls.
  run::Listener& ear(std::size_t ball);

  /// The endings belong to the balls, in their order.
  tl::expected<void, IoError> finish(const std::vector<run::Ending>& endings);

private:
  class Ear;
  struct Told {
    Duration t;
    std::size_t rank = 0; ///< of the ball, by name
    std::string text;
    bool traced = false;
  };
  void tell(Duration t, std::size_t rank, std::string text, bool traced);
  void flush();
  void put(const Told& told);

  const RunOptions& options_;
  std::optional<report::TraceFormat> format_;
  bool prints_;
  std::vector<std::unique_ptr<Ear>> ears_;
  std::vector<Told> waiting_; ///< until all balls have come as far
  std::string text_;          ///< of a trace that goes to a file
};

} // namespace orb::cli
