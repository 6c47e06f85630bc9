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

/// A message is a line of its own, whatever names are in it: what comes after the end of a line
/// would be read by a CI as something else.
std::string on_one_line(std::string_view message) {
  std::string out;
  for (const char c : message)
    if (c == '\n' || c == '\r')
      out += c == '\n' ? "\\n" : "\\r";
    else
      out += c;
  return out;
}

/// Empty where this thread prints to the streams of the process.
thread_local OutputTap::Take tap;

/// Whether the tap has taken it.
bool is_taken(OutputTap::Stream stream, std::string_view text) {
  if (tap)
    tap(stream, text);
  return static_cast<bool>(tap);
}

/// A ball's or a file's name must not drive the user's terminal.
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
  // What is cleaned up after a first failure may still want to say something, such as a ball whose
  // client leaves. A second exception would be the end of the process.
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
