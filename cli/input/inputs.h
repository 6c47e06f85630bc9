#pragma once

#include "cli/context/context.h"
#include "cli/input/links.h"
#include "report/course.h"
#include "run/input.h"
#include "vm/stimulus.h"

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace CLI {
class App;
}

namespace orb::cli {

class Command;

/// Adds `--lang basic|structured|macro`, which overrides the file extension.
void add_language_option(const Command& command, std::string& lang);

/// Reads the file at `path`, which may lie inside a file of addresses, or standard input for `-`.
tl::expected<std::string, Failure> read_text(const std::string& path);

/// Reads the files that a program names from disk.
class DiskFiles final : public structured::Files {
public:
  std::optional<std::string> read(const std::string& path) override;
  Message obstacle(const std::string& path) override;
  Message trouble(const std::string& path) override;
  std::string identity(const std::string& path) override;

private:
  Links links_;
};

/// Reads a program or macro source.
tl::expected<run::SourceFile, Failure> read_source(const std::string& path, std::string_view lang);

/// Reads programs and macros for a ball, with the macros that the programs use; does not print
/// findings.
tl::expected<std::vector<run::Input>, Failure> read_inputs(const std::vector<std::string>& paths,
                                                           std::string_view lang,
                                                           const compiler::Target& target);

/// Adds `--stimulus`: a script or one of its lines, repeatable.
void add_stimulus_option(const Command& command, std::vector<std::string>& stimuli);

/// True if the value of `--stimulus` is a line (`at 2s shake`, `wall x=50`), not a file.
bool is_stimulus_line(const std::string& given);

/// Reads the values of `--stimulus`; prints mistakes to stderr.
tl::expected<std::vector<vm::TimedStimulus>, Failure>
read_stimuli(const Context& context, const std::vector<std::string>& given);

/// Adds `--course`, the drawing of what the ball drives through.
void add_course_option(const Command& command, std::string& path);

/// Reads the drawing; prints findings to stderr.
tl::expected<report::Course, Failure> read_course(const Context& context, const std::string& path);

/// Prints a finding to stderr.
void print_finding(const Context& context, const Source& source, const Diagnostic& diagnostic);

/// Prints findings to stderr: errors always, warnings unless -q, the rest with -v. Returns true if
/// there is an error.
bool print_findings(const Context& context, const Source& source,
                    const std::vector<Diagnostic>& findings);

/// The same for all files of an input.
bool print_findings(const Context& context, const std::vector<FileFindings>& files);

/// Prints the findings of the first input with errors and fails; succeeds if there is none.
tl::expected<void, Failure> check_inputs(const Context& context,
                                         const std::vector<run::Input>& inputs);

} // namespace orb::cli
