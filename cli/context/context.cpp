#include "cli/context/context.h"

#include "base/text/utf8.h"
#include "cli/context/console.h"
#include "cli/context/output_error.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fmt/format.h>
#include <utility>

namespace orb::cli {
namespace {

bool is_set(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

Style style_for(const std::string& color, Stream stream) {
  if (color == "always")
    return {true};
  if (color == "never")
    return {false};
  if (is_set("NO_COLOR"))
    return {false};
  if (is_set("CLICOLOR_FORCE") && std::string_view(std::getenv("CLICOLOR_FORCE")) != "0")
    return {true};
  return {can_draw(stream)};
}

/// Keeps a message on one line, even if names in it contain line ends: a CI would read the next
/// line as something else.
std::string on_one_line(std::string_view message) {
  std::string out;
  for (const char c : message)
    if (c == '\n' || c == '\r')
      out += c == '\n' ? "\\n" : "\\r";
    else
      out += c;
  return out;
}

/// Empty if this thread prints to the streams of the process.
thread_local OutputTap::Take tap;

/// Returns true if the tap took it.
bool is_taken(OutputTap::Stream stream, std::string_view text) {
  if (tap)
    tap(stream, text);
  return static_cast<bool>(tap);
}

/// Escapes control characters: the name of a ball or file must not control the user's terminal.
bool print_to(Stream stream, std::string_view text) {
  std::string shown;
  if (is_terminal(stream))
    text = shown = to_terminal_text(text);
  return write_to(stream, text);
}

} // namespace

Style Context::out_style() const {
  return style_for(color, Stream::Out);
}

Style Context::err_style() const {
  return style_for(color, Stream::Err);
}

OutputTap::OutputTap(Take take) {
  tap = std::move(take);
}

OutputTap::~OutputTap() {
  tap = nullptr;
}

OutputTap::Closed::Closed() : take_(std::exchange(tap, nullptr)) {}

OutputTap::Closed::~Closed() {
  tap = std::move(take_);
}

void print_out(std::string_view text) {
  // Clean-up after a failure may still print, for instance that a ball's client has left. A second
  // exception would terminate the process.
  if (std::uncaught_exceptions() > 0)
    return;
  if (is_taken(OutputTap::Stream::Out, text))
    return;
  if (!print_to(Stream::Out, text))
    throw OutputError{errno};
}

void print_err(std::string_view text) {
  if (!is_taken(OutputTap::Stream::Err, text))
    print_to(Stream::Err, text);
}

void print_note(const Context& context, std::string_view message) {
  if (!context.quiet)
    print_err(fmt::format("{}\n", on_one_line(message)));
}

void print_warning(const Context& context, std::string_view message) {
  print_err(fmt::format("orb: {}: {}\n", context.err_style().paint(Role::Warning, "warning"),
                        on_one_line(message)));
}

void print_error(const Context& context, std::string_view message) {
  print_err(fmt::format("orb: {}: {}\n", context.err_style().paint(Role::Error, "error"),
                        on_one_line(message)));
}

void print_ended(const Context& context, ExitCode how, std::string_view message) {
  if (how == ExitCode::Done)
    print_note(context, message);
  else
    print_error(context, message);
}

void fail(Context& context, const Failure& failure) {
  print_error(context, failure.message);
  context.exit = failure.code;
}

} // namespace orb::cli
