#include "assembler/lint.h"

#include "assembler/layout.h"
#include "assembler/lint_timing.h"
#include "assembler/parse.h"
#include "assembler/rules.h"
#include "assembler/timing.h"
#include "base/silence.h"
#include "base/text.h"
#include "repair/repair.h"

#include <algorithm>
#include <bitset>
#include <fmt/format.h>
#include <iterator>

namespace orb::assembler {
namespace {

using spec::MacroBackground;
using spec::MacroCommand;
using spec::MacroFlag;
using spec::MacroIdKind;
using Origin = PlacedCommand::Origin;
using Ids = std::bitset<spec::macro_id_temporary + 1>;

bool leads_elsewhere(MacroCommand kind) {
  return kind == MacroCommand::Goto || kind == MacroCommand::Gosub ||
         kind == MacroCommand::OnCollision;
}

Ids ids_of(const Assembly& assembly) {
  Ids ids;
  for (const auto& macro : assembly.macros)
    if (macro.id)
      ids.set(*macro.id);
  return ids;
}

class Linter {
public:
  Linter(const Source& source, const Assembly& assembly, const LintOptions& options,
         const Ids& known)
      : source_(source), assembly_(assembly), options_(options), known_(known) {}

  std::vector<Diagnostic> run() {
    for (const auto& macro : assembly_.macros) {
      check_size(macro);
      check_flags(macro);
      check_commands(macro);
      check_loops(macro);
      check_robot(macro);
    }
    check_heap();
    check_gosub_depth();
    check_collisions();
    check_rolls();
    if (any_error(assembly_.diagnostics))
      return std::move(diagnostics_); // a line that does not parse may take the time
    auto in_time = lint_timing(assembly_);
    diagnostics_.insert(diagnostics_.end(), std::make_move_iterator(in_time.begin()),
                        std::make_move_iterator(in_time.end()));
    return std::move(diagnostics_);
  }

private:
  Diagnostic& report(const Rule& rule, Span span, std::string message, std::string help = {}) {
    diagnostics_.push_back(finding(rule, span, std::move(message), std::move(help)));
    return diagnostics_.back();
  }

  void check_robot(const AssembledMacro& macro) {
    if (!options_.robot)
      return;
    for (const auto& command : macro.commands)
      if (const auto* lack = spec::find_lack(*options_.robot, command.info->mnemonic))
        report(rules::RobotLacks, command.span,
               fmt::format("the {} has no `{}`: {}", spec::info(*options_.robot).title, lack->word,
                           lack->why));
  }

  static MacroIdKind kind_of(const AssembledMacro& macro) {
    return spec::macro_id_kind(macro.id.value_or(spec::macro_id_temporary));
  }

  void check_size(const AssembledMacro& macro) {
    const auto size = macro.framed_size();
    if (size <= spec::macro_max_packet)
      return;
    switch (kind_of(macro)) {
    case MacroIdKind::Stream: return;
    case MacroIdKind::None:
    case MacroIdKind::System:
    case MacroIdKind::User:
      report(
          rules::TooLarge, macro.span,
          fmt::format(
              "the macro is {} bytes; a user macro can be at most {}, including id, flags and end",
              size, spec::macro_max_packet),
          "split it and chain the parts with `goto`");
      return;
    case MacroIdKind::Temporary:
      if (size <= spec::macro_buffer_size)
        report(rules::NeedsChunks, macro.span,
               fmt::format("the macro is {} bytes and is sent in chunks", size));
      else if (macro.id)
        report(rules::TooLarge, macro.span,
               fmt::format("the macro is {} bytes; the temporary macro can be at most {}", size,
                           spec::macro_buffer_size),
               fmt::format("stream it: `id={}`", spec::macro_id_stream));
      else
        report(rules::NeedsStream, macro.span,
               fmt::format("the macro is {} bytes; the ball's buffer is {}", size,
                           spec::macro_buffer_size),
               fmt::format("stream it: `id={}`", spec::macro_id_stream));
    }
  }

  void check_flags(const AssembledMacro& macro) {
    if (macro.flags && spec::has_flag(*macro.flags, MacroFlag::Unkillable) &&
        kind_of(macro) != MacroIdKind::System)
      report(rules::Unkillable, macro.flags_span,
             fmt::format("the ball ignores `{}` here", spec::info(MacroFlag::Unkillable).word),
             "remove the flag");
  }

  void check_commands(const AssembledMacro& macro) {
    const bool stream = kind_of(macro) == MacroIdKind::Stream;
    const PlacedCommand* leaves = nullptr;
    for (const auto& command : macro.commands) {
      if (command.info == nullptr || command.origin == Origin::Supplied)
        continue;
      const auto kind = command.info->command;
      const auto word = command.info->mnemonic;
      if (command.info->executive > options_.executive)
        report(rules::Executive, command.span,
               fmt::format("`{}` needs macro executive {}, the target has {}", word,
                           command.info->executive, options_.executive));
      if (command.info->place == spec::MacroPlace::OnlyInStream && !stream) {
        auto& diagnostic =
            report(rules::StreamOnly, command.span,
                   fmt::format("`{}` aborts a macro that is not a stream", word),
                   fmt::format("write `end`, or give the macro `id={}`", spec::macro_id_stream));
        if (!macro.id)
          diagnostic.severity = Severity::Warning; // it may be sent as a stream yet
      }
      if (command.info->place == spec::MacroPlace::NeverInStream && stream)
        report(rules::NeverInStream, command.span,
               fmt::format("the stream macro ignores `{}`", word),
               kind == MacroCommand::End ? "`stream_end` ends it" : "");
      if (leaves != nullptr && kind != MacroCommand::End && kind != MacroCommand::Comment) {
        report(
            rules::Unreachable, command.span,
            fmt::format("`{}` is unreachable: `{}` does not return", word, leaves->info->mnemonic))
            .notes.push_back({leaves->span, "control leaves the macro here"});
        leaves = nullptr;
      }
      if (kind == MacroCommand::Goto || kind == MacroCommand::Sleep ||
          (stream && kind == MacroCommand::StreamEnd))
        leaves = &command;
      if (command.origin == Origin::Written)
        check_values(command);
    }
    if (!macro.has_end && !stream)
      report(rules::MissingEnd, macro.commands.empty() ? macro.span : macro.commands.back().span,
             "missing `end`", "remove `.noend`");
  }

  void check_values(const PlacedCommand& command) {
    const auto kind = command.info->command;
    if (leads_elsewhere(kind))
      check_target(command);
    if (kind == MacroCommand::Marker && command.value[0] == spec::macro_end_marker)
      report(rules::MarkerZero, command.operand, "marker 0 is emitted at the end of a macro",
             fmt::format("use one from {}", spec::macro_reserved_markers + 1));
    if (kind == MacroCommand::Marker && command.value[0] > 0 &&
        command.value[0] <= spec::macro_reserved_markers)
      report(rules::MarkerReserved, command.operand,
             fmt::format("the vendor's client uses markers 1 to {} to pace streams",
                         spec::macro_reserved_markers));
    if (kind == MacroCommand::LoopStart && command.value[0] == 0)
      report(rules::LoopZero, command.operand, "a loop count of 0 runs once",
             "write 1, or remove it");
    check_time(command);
  }

  /// A time without a unit that is too short for anything: seconds were meant.
  void check_time(const PlacedCommand& command) {
    constexpr std::int32_t shortest_ms = 10;
    if (command.info->operand_count == 0)
      return;
    const auto last = command.info->operand_count - 1U;
    const auto& operand = command.info->operand[last];
    const auto ms = command.value[last];
    const auto written = source_.text(command.span);
    if (operand.unit != spec::MacroUnit::Milliseconds || operand.maximum <= UINT8_MAX || ms <= 0 ||
        ms >= shortest_ms || !is_digit(written.back()))
      return;
    const Span span{command.span.end - 1, command.span.end};
    auto& d = report(rules::ShortTime, span, fmt::format("`{}` without a unit is {} ms", ms, ms),
                     fmt::format("write `{}s`", written));
    d.fix = Fix{d.help, {{{span.end, span.end}, "s"}}, Safety::Unsafe};
  }

  void check_target(const PlacedCommand& command) {
    const auto id = static_cast<std::uint8_t>(command.value[0]);
    const auto word = command.info->mnemonic;
    switch (spec::macro_id_kind(id)) {
    case MacroIdKind::Stream:
      report(rules::StreamTarget, command.operand,
             fmt::format("`{}` cannot lead to the stream macro, {}", word, id),
             fmt::format("{} to {} are user macros, {} is the temporary one",
                         spec::macro_id_user_first, spec::macro_id_user_last,
                         spec::macro_id_temporary));
      return;
    case MacroIdKind::None:
      if (command.info->command != MacroCommand::OnCollision)
        report(rules::UnknownTarget, command.operand, "id 0 is not a macro");
      return;
    case MacroIdKind::User:
      if (!known_[id])
        report(rules::UnknownTarget, command.operand,
               fmt::format("no macro in these files has id {}", id),
               fmt::format("check it together with the file that defines `id={}`", id));
      return;
    case MacroIdKind::System:
    case MacroIdKind::Temporary: return;
    }
  }

  void check_loops(const AssembledMacro& macro) {
    const PlacedCommand* open = nullptr;
    int replaced = 0;
    for (const auto& command : macro.commands) {
      if (is(command, MacroCommand::LoopStart) || is(command, MacroCommand::LoopStartSystem)) {
        if (open != nullptr) {
          report(rules::NestedLoop, command.span, "this loop replaces the previous one",
                 "loops do not nest; multiply the counts, or repeat the commands")
              .notes.push_back({open->span, "which begins here"});
          ++replaced;
        }
        open = &command;
      } else if (is(command, MacroCommand::LoopEnd)) {
        if (open == nullptr && replaced > 0)
          --replaced; // explained by the nesting
        else if (open == nullptr)
          report(rules::LoopEnd, command.span, "`loop_end` without `loop_start`",
                 "remove it, or add `loop_start` above");
        open = nullptr;
      } else if (open != nullptr && is(command, MacroCommand::End) && command.span.size() > 0) {
        auto& d = report(rules::LoopOpen, command.span, "`end` in a loop ends the whole macro",
                         "write `loop_end`");
        d.fix = Fix{d.help, {{command.span, "loop_end"}}, Safety::Unsafe};
        d.notes.push_back({open->span, "the loop"});
        return;
      }
    }
    if (open == nullptr || any_error(assembly_.diagnostics))
      return;
    auto& d = report(rules::LoopOpen, open->span, "unterminated loop", "write `loop_end` below");
    const auto last = std::find_if(
        macro.commands.rbegin(), macro.commands.rend(),
        [](const PlacedCommand& command) { return command.origin != Origin::Supplied; });
    const auto end = source_.line_span(line_of(*last)).end;
    const auto line = source_.line(line_of(*open));
    const auto indent = line.substr(0, line.find_first_not_of(" \t"));
    d.fix = Fix{d.help,
                {{{end, end}, fmt::format("{}{}loop_end", line_end_of(source_.text()), indent)}},
                Safety::Unsafe};
  }

  std::uint32_t line_of(const PlacedCommand& command) const {
    return source_.position(command.span.begin).line;
  }

  /// The user macros of a file share the heap and the index of a ball.
  void check_heap() {
    std::size_t heap = 0;
    std::size_t entries = 0;
    for (const auto& macro : assembly_.macros) {
      if (kind_of(macro) != MacroIdKind::User)
        continue;
      heap += macro.framed_size();
      ++entries;
      if (heap <= spec::macro_heap_size && entries <= spec::macro_heap_entries)
        continue;
      report(
          rules::HeapFull, macro.span,
          entries > spec::macro_heap_entries
              ? fmt::format("this is user macro number {}; the ball has room for {}", entries,
                            spec::macro_heap_entries)
              : fmt::format("with this one the user macros total {} bytes; the ball's heap is {}",
                            heap, spec::macro_heap_size),
          "run some of them as temporary macros");
      return;
    }
  }

  void check_collisions() {
    const PlacedCommand* asks = nullptr;
    for (const auto& macro : assembly_.macros)
      for (const auto& command : macro.commands) {
        if (is(command, MacroCommand::ConfigureCollision))
          return;
        if (asks == nullptr && is(command, MacroCommand::OnCollision) && command.value[0] > 0)
          asks = &command;
      }
    if (asks != nullptr && !any_error(assembly_.diagnostics))
      report(rules::CollisionsOff, asks->span,
             "nothing here switches the detection of collisions on",
             "write `configure_collision 1, 100, 50, 100, 50, 200ms` above, where no client does");
  }

  /// The only roll has speed 0, and then the ball is stopped: speed and heading are exchanged.
  void check_rolls() {
    const PlacedCommand* roll = nullptr;
    bool stops = false;
    for (const auto& macro : assembly_.macros)
      for (const auto& command : macro.commands) {
        if (command.info == nullptr || command.origin == Origin::Broken)
          return;
        const auto kind = command.info->command;
        const bool rolls = kind == MacroCommand::Roll || kind == MacroCommand::Roll2;
        if (kind == MacroCommand::RollSd1 || kind == MacroCommand::RollSpd1Sd1 ||
            kind == MacroCommand::RollSpd2Sd1 || kind == MacroCommand::RawMotors ||
            kind == MacroCommand::Goto || kind == MacroCommand::Gosub)
          return; // it may drive in another way
        if ((rolls || kind == MacroCommand::SetSpeed) && command.value[0] > 0)
          return;
        stops = stops || (roll != nullptr && (rolls || kind == MacroCommand::SetSpeed));
        if (rolls && command.value[1] > 0 && roll == nullptr)
          roll = &command;
      }
    if (roll == nullptr || !stops || roll->value[1] > UINT8_MAX)
      return;
    report(rules::NeverRolls, roll->span,
           "the ball never rolls: its speed is 0 here, and nowhere else more",
           fmt::format("write `roll {}, 0{}`; the speed stands first", roll->value[1],
                       roll->value[2] > 0 ? fmt::format(", {}ms", roll->value[2]) : ""));
  }

  void check_gosub_depth() {
    struct Call {
      const AssembledMacro* from;
      const PlacedCommand* command;
    };
    std::vector<Call> calls;
    for (const auto& macro : assembly_.macros)
      for (const auto& command : macro.commands)
        if (is(command, MacroCommand::Gosub))
          calls.push_back({&macro, &command});
    for (const auto& inner : calls)
      for (const auto& outer : calls)
        if (outer.from != inner.from &&
            inner.from->id.value_or(spec::macro_id_temporary) == outer.command->value[0]) {
          report(rules::GosubDepth, inner.command->span,
                 "this `gosub` is ignored when the macro itself was called",
                 "calls are one level deep; let the caller call both")
              .notes.push_back({outer.command->span, "it is called here"});
          break;
        }
  }

  const Source& source_;
  const Assembly& assembly_;
  const LintOptions& options_;
  const Ids& known_;
  std::vector<Diagnostic> diagnostics_;
};

/// Leaves out what remarks allow.
void silence(const Source& source, std::vector<Diagnostic>& diagnostics) {
  std::vector<AllowComment> comments;
  for (auto found = source.text().find(allow_mark); found != std::string_view::npos;
       found = source.text().find(allow_mark, found + allow_mark.size())) {
    const auto number = source.position(static_cast<std::uint32_t>(found)).line;
    const auto line = source.line(number);
    const auto remark = remark_of(line);
    const auto start = source.line_start(number);
    if (found < start + remark)
      continue; // in a text
    const auto end = start + static_cast<std::uint32_t>(line.size());
    const bool alone = line.substr(0, remark).find_first_not_of(" \t") == std::string_view::npos;
    const auto about = alone ? number + 1 : number;
    const auto about_end = source.line_span(about).end + 1;
    comments.push_back(
        {{static_cast<std::uint32_t>(found), end}, {source.line_start(about), about_end}});
  }
  if (!comments.empty())
    orb::silence(source.text(), comments, rules::all(), rules::UnknownRule, diagnostics);
}

} // namespace

std::vector<Diagnostic> lint(const Source& source, const Assembly& assembly,
                             const LintOptions& options) {
  auto found = Linter(source, assembly, options, ids_of(assembly)).run();
  silence(source, found);
  return found;
}

namespace {

std::vector<std::string_view> all_words() {
  std::vector<std::string_view> words{".macro", ".const", ".raw", ".noend", "on",      "off",  "id",
                                      "flags",  "delay",  "time", "speed",  "heading", "angle"};
  for (const auto& row : spec::macro_commands)
    words.push_back(row.mnemonic);
  return words;
}

/// The line to write, for each error; what other files define stays defined.
void offer_lines(const Source& source, const Ids& known, const LintOptions& options,
                 std::vector<Diagnostic>& findings) {
  repair::Judge judge;
  judge.language = repair::Language::Macro;
  judge.words = all_words();
  judge.parses = [](std::string_view line) { return parse(line).diagnostics.empty(); };
  judge.check = [&](std::string_view text) {
    const Source changed(source.name(), std::string(text));
    const auto assembly = assemble(changed);
    auto found = assembly.diagnostics;
    auto more = Linter(changed, assembly, options, known | ids_of(assembly)).run();
    silence(changed, more);
    found.insert(found.end(), more.begin(), more.end());
    return found;
  };
  repair::offer_lines(source.text(), judge, findings);
}

} // namespace

std::vector<FileFindings> check(std::span<const Source* const> sources,
                                const LintOptions& options) {
  std::vector<Assembly> assemblies;
  Ids known;
  for (const auto* source : sources) {
    assemblies.push_back(assemble(*source));
    known |= ids_of(assemblies.back());
  }
  std::vector<FileFindings> files;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    auto& file = files.emplace_back();
    file.source = sources[i];
    file.diagnostics = assemblies[i].diagnostics;
    auto found = Linter(*sources[i], assemblies[i], options, known).run();
    silence(*sources[i], found);
    file.diagnostics.insert(file.diagnostics.end(), std::make_move_iterator(found.begin()),
                            std::make_move_iterator(found.end()));
    if (any_error(file.diagnostics))
      offer_lines(*sources[i], known, options, file.diagnostics);
    if (assemblies[i].has_errors())
      continue;
    std::size_t size = 0;
    for (const auto& macro : assemblies[i].macros)
      size += macro.framed_size();
    file.built_size = size;
  }
  for (auto& file : files)
    sort_by_place(file.diagnostics);
  return files;
}

std::vector<Diagnostic> check(const Source& source, const LintOptions& options) {
  const Source* const sources[] = {&source};
  return std::move(check(sources, options).front().diagnostics);
}

bool cannot_be_sent(const Diagnostic& diagnostic) {
  return diagnostic.rule == &rules::TooLarge || diagnostic.rule == &rules::StreamTarget;
}

} // namespace orb::assembler
