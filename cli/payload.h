#pragma once

#include "base/source.h"
#include "cli/context.h"
#include "compiler/image.h"
#include "compiler/lint.h"
#include "protocol/macro.h"

#include <memory>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

namespace orb::cli {

/// A macro out of a file.
struct MacroPayload {
  std::string name;
  protocol::MacroImage image;
  bool has_id = false; ///< the file gives the id; else it is the temporary one
};

/// A file as it can be sent to a ball: one program, or one or more macros.
struct Payload {
  std::unique_ptr<Source> source;
  std::optional<compiler::Image> program;
  std::vector<MacroPayload> macros;
  std::vector<Diagnostic> diagnostics;
};

/// Why a file cannot be sent, and the code to end with.
struct PayloadFailure {
  ExitCode exit = ExitCode::File;
  std::string message;
};

/// What is said about a file before it is used.
enum class Findings : std::uint8_t { Lint, None };

/// Reads a file by its ending, or as `lang` says (`basic`, `macro` or empty). Source is linted and
/// built, `.sphero` and `.bin` are taken as they are. A file with errors is a payload all the same:
/// its diagnostics say so.
tl::expected<Payload, PayloadFailure> load_payload(const std::string& path, std::string_view lang,
                                                   const compiler::Target& target,
                                                   Findings findings);

/// Prints the findings of a file to stderr; true when there is an error among them. Below an error
/// they are left out where the user wants quiet.
bool print_findings(const Context& context, const Payload& payload);

} // namespace orb::cli
