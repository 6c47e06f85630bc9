#include "assembler/lint/lint_loops.h"

#include "assembler/lint/edits.h"
#include "assembler/lint/lint_timing.h"
#include "assembler/text/layout.h"
#include "assembler/text/rules.h"
#include "assembler/text/texts.h"
#include "base/fixes.h"
#include "repair/arrange.h"

#include <algorithm>
#include <string>
#include <utility>

namespace orb::assembler {
namespace {

using spec::MacroCommand;
using Origin = PlacedCommand::Origin;

constexpr std::size_t longest_line = 240; // bytes; longer lines are not examined

class LoopLinter {
public:
  LoopLinter(const Source& source, const Assembly& assembly)
      : source_(source), assembly_(assembly) {}

  std::vector<Diagnostic> run() {
    for (const auto& macro : assembly_.macros)
      check(macro);
    return std::move(diagnostics_);
  }

private:
  Diagnostic& report(const Rule& rule, Span span, Message message, Message help = {}) {
    diagnostics_.push_back(finding(rule, span, std::move(message), std::move(help)));
    return diagnostics_.back();
  }

  std::uint32_t line_of(const PlacedCommand& command) const {
    return source_.position(command.span.begin).line;
  }

  void check(const AssembledMacro& macro) {
    const PlacedCommand* open = nullptr;
    const PlacedCommand* before = nullptr;
    int replaced = 0;
    for (const auto& command : macro.commands) {
      if (is(command, MacroCommand::LoopStart) || is(command, MacroCommand::LoopStartSystem)) {
        if (open != nullptr) {
          report(rules::NestedLoop, command.span, texts::ReplacesLoop(), texts::NoNesting())
              .notes.push_back({open->span, texts::PreviousBegins()});
          ++replaced;
        }
        check_count(command);
        open = &command;
      } else if (is(command, MacroCommand::LoopEnd)) {
        if (open == nullptr && replaced > 0)
          --replaced; // explained by the nesting
        else if (open == nullptr)
          second_end(command, before);
        open = nullptr;
      } else if (open != nullptr && is(command, MacroCommand::End) && command.span.size() > 0) {
        auto& d =
            report(rules::LoopOpen, command.span, texts::EndsMacro(), texts::Write("loop_end"));
        d.fix = single_fix(d.help, command.span, "loop_end", Safety::Unsafe);
        d.notes.push_back({open->span, texts::TheLoop()});
        return;
      }
      before = &command;
    }
    if (open != nullptr && !any_error(assembly_.diagnostics))
      left_open(macro, *open);
  }

  void check_count(const PlacedCommand& command) {
    if (command.info == nullptr || !is(command, MacroCommand::LoopStart) || command.value[0] > 1)
      return;
    const auto said = count_said(command);
    auto& d = command.value[0] == 0 ? report(rules::LoopZero, command.operand,
                                             texts::ZeroRunsOnce(), texts::WriteOneOrRemove())
                                    : report(rules::LoopOne, command.operand,
                                             texts::OneRepeatsNothing(), texts::WriteIterations());
    if (said <= 1)
      return;
    d.help = texts::Write("loop_start " + std::to_string(said));
    d.fix = single_fix(d.help, command.operand, std::to_string(said), Safety::Unsafe);
  }

  /// The number of repetitions in the remarks above a command, `three times`; 0 if there is none.
  int count_said(const PlacedCommand& command) const {
    int said = 0;
    for (std::uint32_t n = 1; n <= line_of(command); ++n) {
      const auto line = source_.line(n);
      const auto tokens = repair::tokens_of(line.substr(std::min(remark_of(line) + 1, line.size())),
                                            repair::Language::Macro);
      for (std::size_t i = 0; i + 1 < tokens.size(); ++i)
        if (repair::is_called("times", tokens[i + 1].text))
          said = repair::count_of(tokens[i]);
    }
    return said;
  }

  /// True if a line above has an error and looks like the start of a loop.
  bool may_begin_above(const PlacedCommand& command) const {
    return std::any_of(
        assembly_.diagnostics.begin(), assembly_.diagnostics.end(), [&](const Diagnostic& error) {
          const auto line = source_.line(source_.position(error.span.begin).line);
          return error.span.begin < command.span.begin && line.size() < longest_line &&
                 begins_loop(repair::split(line, repair::Language::Macro).tokens);
        });
  }

  static bool begins_loop(const repair::Tokens& line) {
    if (line.empty())
      return false;
    const auto& word = line[0].text;
    const auto meanings = repair::meanings_of(word);
    return word.find("loop") != std::string::npos || word == "repeat" || word == "for" ||
           word == "while" || word == "forever" ||
           std::find(meanings.begin(), meanings.end(), "loop_start") != meanings.end();
  }

  void second_end(const PlacedCommand& command, const PlacedCommand* before) {
    if (may_begin_above(command))
      return;
    auto& d = report(rules::LoopEnd, command.span, texts::Without("loop_end", "loop_start"),
                     texts::RemoveOrAdd("loop_start"));
    if (before == nullptr || !is(*before, MacroCommand::LoopEnd) ||
        any_error(assembly_.diagnostics))
      return;
    d.help = texts::RemoveLine();
    d.fix = Fix{d.help, {without_line(source_, line_of(command))}, Safety::Unsafe};
  }

  void left_open(const AssembledMacro& macro, const PlacedCommand& open) {
    const auto* last = last_inside(macro, open);
    const auto line = line_of(*last);
    auto& d = report(rules::LoopOpen, open.span, texts::OpenLoop());
    d.help =
        last == &open ? texts::WriteBelow("loop_end") : texts::WriteBelowLine("loop_end", line);
    d.fix = Fix{texts::Write("loop_end"),
                {below(source_, line, indent_of(source_, line_of(open)), "loop_end")},
                Safety::Unsafe};
  }

  /// The last command that an unclosed loop was meant to repeat: the last indented one, else the
  /// last before the closing commands that stop and darken the ball.
  const PlacedCommand* last_inside(const AssembledMacro& macro, const PlacedCommand& open) const {
    const auto first = static_cast<std::size_t>(&open - macro.commands.data());
    auto last = macro.commands.size();
    while (last > first + 1 && macro.commands[last - 1].origin == Origin::Supplied)
      --last;
    const auto margin = indent_of(source_, line_of(open)).size();
    const auto deep = [&](std::size_t i) {
      return indent_of(source_, line_of(macro.commands[i])).size() > margin;
    };
    if (first + 1 < last && deep(first + 1)) {
      auto at = first + 1;
      while (at < last && deep(at))
        ++at;
      return &macro.commands[at - 1];
    }
    auto end = last;
    while (end > first + 2 && finishes(macro.commands[end - 1]))
      --end;
    return &macro.commands[end - 1];
  }

  /// True if a command closes a routine: it takes no time and leaves the ball at rest.
  static bool finishes(const PlacedCommand& command) {
    if (command.info == nullptr || command.origin != Origin::Written)
      return false;
    const auto kind = command.info->command;
    if (kind == MacroCommand::WaitUntilStopped || kind == MacroCommand::Goto ||
        kind == MacroCommand::Sleep)
      return true;
    const bool rests = kind == MacroCommand::Roll || kind == MacroCommand::SetSpeed;
    const bool darkens = kind == MacroCommand::Rgb || kind == MacroCommand::BackLed;
    const std::size_t channels = kind == MacroCommand::Rgb ? 3 : 1;
    return (rests || darkens) && command.value[command.info->operand_count - 1U] == 0 &&
           std::all_of(command.value.begin(),
                       command.value.begin() + static_cast<std::ptrdiff_t>(channels),
                       [](std::int32_t value) { return value == 0; });
  }

  const Source& source_;
  const Assembly& assembly_;
  std::vector<Diagnostic> diagnostics_;
};

} // namespace

std::vector<Diagnostic> lint_loops(const Source& source, const Assembly& assembly) {
  return LoopLinter(source, assembly).run();
}

} // namespace orb::assembler
