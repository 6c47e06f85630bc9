#pragma once

#include "base/bytes.h"
#include "base/source.h"
#include "base/time.h"
#include "cli/context.h"
#include "compiler/program.h"
#include "protocol/macro.h"
#include "vm/stimulus.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace orb::cli {

/// A program as the user gave it, and as it goes to the ball.
struct ProgramFile {
  Source source;
  compiler::Program program; ///< refers to the source
  Bytes image;
  std::uint16_t first_line = 0; ///< where it starts
};

struct MacroFile {
  std::string name;
  protocol::MacroImage image;
  std::string text;               ///< the file's source; empty where it holds bytes
  std::vector<int> command_lines; ///< where command number k + 1 stands in the source
};

/// Everything that a run is made of.
struct RunInputs {
  std::vector<std::unique_ptr<ProgramFile>> programs; ///< the first one runs
  std::vector<MacroFile> macros;
  std::vector<vm::TimedStimulus> stimuli;
};

/// Why a run does not begin.
struct Refusal {
  ExitCode code = ExitCode::BadInput;
  std::string message;
};

template <class Value>
using RunResult = tl::expected<Value, Refusal>;

tl::unexpected<Refusal> refuse(ExitCode code, std::string message);

/// Reads programs, macros and a stimulus script (an empty path: none). `language` is `basic`,
/// `macro` or empty: then the ending decides. Mistakes of the script, and of macro source, go to
/// stderr as findings.
RunResult<RunInputs> read_run_inputs(const std::vector<std::string>& files,
                                     std::string_view language, const std::string& stimulus,
                                     const Context& context);

/// `60s`, `500ms`, `2min`, `1h`; a bare number counts seconds.
std::optional<Duration> read_duration(std::string_view text);

} // namespace orb::cli
