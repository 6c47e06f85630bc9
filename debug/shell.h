#pragma once

#include "debug/debugger.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

// The debugger's command line: commands in, text out.

namespace orb::debug {

/// The first word of a line, and the rest without surrounding blanks.
struct Split {
  std::string_view word;
  std::string_view rest;
};
Split split(std::string_view line);

/// Runs a line that changes something: `set`, `input`, or an event for the ball (`shake`, `push 90
/// 120`). Returns the result; nothing for other lines.
std::optional<tl::expected<std::string, std::string>> change_by_words(Debugger& debugger,
                                                                      std::string_view line);

/// Describes in a sentence how a run ended.
std::string ending_of(const Debugger& debugger);

/// Commands in, text out. Large because each command is a member, listed in one table.
class Shell {
public:
  /// Writes a file that a command names; fails with a sentence.
  using Write = std::function<tl::expected<void, std::string>(const std::string& name,
                                                              std::string_view text)>;
  Shell(Debugger& debugger, Console& console, Write write);

  /// Runs a command line; an empty one repeats a step.
  void obey(std::string_view line, const GiveUp& give_up);
  /// Prints the line that is about to run, as after each move.
  void show_place();
  bool done() const { return done_; }

  /// Tells if an empty line repeats the command.
  enum class Repeats : std::uint8_t { No, Yes };
  /// A command, as in `help`.
  struct Row {
    std::string_view word;
    std::string_view alias;
    std::string_view usage;
    std::string_view summary;
    void (Shell::*act)(std::string_view rest, const GiveUp& give_up);
    Repeats repeats = Repeats::No;
  };

private:
  static std::span<const Row> rows();
  const Row* find(std::string_view word) const;

  void add_break(std::string_view rest, const GiveUp&);
  void add_watch(std::string_view rest, const GiveUp&);
  void add_log(std::string_view rest, const GiveUp&);
  void drop(std::string_view rest, const GiveUp&);
  template <Move move, Direction direction>
  void go(std::string_view, const GiveUp& give_up);
  void go_on(std::string_view, const GiveUp& give_up);
  void until(std::string_view rest, const GiveUp& give_up);
  void jump(std::string_view rest, const GiveUp&);
  void again(std::string_view, const GiveUp&);
  void print(std::string_view rest, const GiveUp&);
  void trace(std::string_view, const GiveUp&);
  void list(std::string_view rest, const GiveUp&);
  void info(std::string_view rest, const GiveUp&);
  void path(std::string_view rest, const GiveUp&);
  void help(std::string_view rest, const GiveUp&);
  void quit(std::string_view, const GiveUp&) { done_ = true; }

  void report(const StopEvent& stop);
  void wrong(std::string_view text) { console_.say(text); }
  std::optional<Spot> spot_of(std::string_view text) const;
  std::string no_place(std::string_view text) const;
  std::string described(const Breakpoint& one) const;
  void show(const std::vector<Variable>& all);

  Debugger& debugger_;
  Console& console_;
  Write write_;
  std::string last_;
  bool done_ = false;
};

} // namespace orb::debug
