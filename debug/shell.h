#pragma once

#include "debug/debugger.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

// The debugger as words: what a person types, and what comes back.

namespace orb::debug {

/// The word that a line begins with, and the rest of it without blanks around.
struct Split {
  std::string_view word;
  std::string_view rest;
};
Split split(std::string_view line);

/// What a line that changes something led to: `set`, `input`, and what happens to the ball
/// (`shake`, `push 90 120`). Nothing where the line is none of these.
std::optional<tl::expected<std::string, std::string>> change_by_words(Debugger& debugger,
                                                                      std::string_view line);

/// How a run ended, in a sentence.
std::string ending_of(const Debugger& debugger);

/// Commands in, text out.
class Shell {
public:
  /// Writes a file that a command names; what failed is a sentence.
  using Write = std::function<tl::expected<void, std::string>(const std::string& name,
                                                              std::string_view text)>;
  Shell(Debugger& debugger, Console& console, Write write);

  /// Does what a line says; an empty one repeats a step.
  void obey(std::string_view line, const GiveUp& give_up);
  /// The line that is about to run, as it is shown after each move.
  void show_place();
  bool done() const { return done_; }

  /// Whether an empty line does it again.
  enum class Repeats : std::uint8_t { No, Yes };
  /// A command, as `help` shows it.
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

  void report(const Stop& stop);
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
