#include "assembler/lint/lint.h"

#include "assembler/lint/edits.h"
#include "assembler/lint/lint_loops.h"
#include "assembler/lint/lint_meant.h"
#include "assembler/lint/lint_timing.h"
#include "assembler/text/layout.h"
#include "assembler/text/parse_macro.h"
#include "assembler/text/rephrase.h"
#include "assembler/text/rules.h"
#include "assembler/text/texts.h"
#include "assembler/timing.h"
#include "base/fixes.h"
#include "base/silence.h"
#include "base/text/suggest.h"
#include "base/text/text.h"
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
      around_ = &macro;
      check_size(macro);
      check_flags(macro);
      check_commands(macro);
      check_robot(macro);
    }
    join(lint_loops(source_, assembly_));
    join(lint_meant(source_, assembly_));
    check_heap();
    check_gosub_depth();
    check_collisions();
    check_rolls();
    if (any_error(assembly_.diagnostics))
      return std::move(diagnostics_); // an unparsed line may be the one that takes time
    join(lint_timing(source_, assembly_));
    return std::move(diagnostics_);
  }

private:
  void join(std::vector<Diagnostic> more) {
    diagnostics_.insert(diagnostics_.end(), std::make_move_iterator(more.begin()),
                        std::make_move_iterator(more.end()));
  }

  Diagnostic& report(const Rule& rule, Span span, Message message, Message help = {}) {
    diagnostics_.push_back(finding(rule, span, std::move(message), std::move(help)));
    return diagnostics_.back();
  }

  void check_robot(const AssembledMacro& macro) {
    if (!options_.robot)
      return;
    for (const auto& command : macro.commands)
      if (const auto* lack = spec::find_lack(*options_.robot, command.info->mnemonic))
        report(rules::RobotLacks, command.span,
               texts::RobotHasNo(spec::info(*options_.robot).title, lack->word,
                                 find_text(texts::all(), lack->why)));
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
      report(rules::TooLarge, macro.span, texts::UserTooLarge(size, spec::macro_max_packet),
             texts::SplitIt());
      return;
    case MacroIdKind::Temporary:
      if (size <= spec::macro_buffer_size)
        report(rules::NeedsChunks, macro.span, texts::InChunks(size));
      else if (macro.id)
        report(rules::TooLarge, macro.span, texts::TemporaryTooLarge(size, spec::macro_buffer_size),
               texts::StreamIt(spec::macro_id_stream));
      else
        report(rules::NeedsStream, macro.span, texts::BeyondBuffer(size, spec::macro_buffer_size),
               texts::StreamIt(spec::macro_id_stream));
    }
  }

  void check_flags(const AssembledMacro& macro) {
    if (macro.flags && spec::has_flag(*macro.flags, MacroFlag::Unkillable) &&
        kind_of(macro) != MacroIdKind::System)
      report(rules::Unkillable, macro.flags_span,
             texts::IgnoresFlag(spec::info(MacroFlag::Unkillable).word), texts::RemoveFlag());
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
               texts::NeedsExecutive(word, command.info->executive, options_.executive));
      if (command.info->place == spec::MacroPlace::OnlyInStream && !stream) {
        auto& diagnostic = report(rules::StreamOnly, command.span, texts::AbortsMacro(word),
                                  texts::WriteEnd(spec::macro_id_stream));
        diagnostic.fix = single_fix(texts::Write("end"), command.span, "end", Safety::Unsafe);
        if (!macro.id)
          diagnostic.severity = Severity::Warning; // it may still be sent as a stream
      }
      if (command.info->place == spec::MacroPlace::NeverInStream && stream)
        report(rules::NeverInStream, command.span, texts::StreamIgnores(word),
               kind == MacroCommand::End ? texts::EndsIt("stream_end") : Message());
      if (leaves != nullptr && kind != MacroCommand::End && kind != MacroCommand::Comment) {
        unreachable(macro, command, *leaves);
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
             texts::Missing("end"), texts::Remove(".noend"));
  }

  /// `sleep` with commands after it: the author meant a wait.
  void sleeps_on(const PlacedCommand& sleep) {
    auto line = std::string(source_.text(sleep.span));
    line.replace(0, sleep.info->mnemonic.size(), spec::info(MacroCommand::Delay).mnemonic);
    auto& d = report(rules::SleepsOn, sleep.span, texts::SwitchesOff(), texts::Write(line));
    d.fix = single_fix(d.help, sleep.span, line, Safety::Unsafe);
  }

  void unreachable(const AssembledMacro& macro, const PlacedCommand& command,
                   const PlacedCommand& leaves) {
    if (is(leaves, MacroCommand::Sleep) && leaves.origin == Origin::Written)
      return sleeps_on(leaves);
    auto& d = report(rules::Unreachable, command.span,
                     texts::DoesNotReturn(command.info->mnemonic, leaves.info->mnemonic));
    d.notes.push_back({leaves.span, texts::LeavesHere()});
    const bool calls =
        is(leaves, MacroCommand::Goto) && leaves.origin == Origin::Written &&
        known_[static_cast<std::uint8_t>(leaves.value[0])] &&
        spec::macro_id_kind(static_cast<std::uint8_t>(leaves.value[0])) == MacroIdKind::User &&
        leaves.value[0] != macro.id && kind_of(macro) != MacroIdKind::Stream;
    if (!calls)
      return;
    auto line = std::string(source_.text(leaves.span));
    line.replace(0, leaves.info->mnemonic.size(), spec::info(MacroCommand::Gosub).mnemonic);
    d.help = texts::WriteOnLine(line, line_of(leaves));
    d.fix = single_fix(texts::Write(line), leaves.span, line, Safety::Unsafe);
  }

  void check_values(const PlacedCommand& command) {
    const auto kind = command.info->command;
    if (leads_elsewhere(kind))
      check_target(command);
    if (kind == MacroCommand::Marker && command.value[0] == spec::macro_end_marker)
      report(rules::MarkerZero, command.operand, texts::EmittedAtEnd(),
             texts::UseHigher(spec::macro_reserved_markers + 1));
    if (kind == MacroCommand::Marker && command.value[0] > 0 &&
        command.value[0] <= spec::macro_reserved_markers)
      report(rules::MarkerReserved, command.operand,
             texts::ClientUses(spec::macro_reserved_markers));
    check_time(command);
  }

  /// A time without a unit that is too short to be useful: the author meant seconds.
  void check_time(const PlacedCommand& command) {
    constexpr std::int32_t shortest_ms = 10;
    if (command.info->operand_count == 0)
      return;
    const auto last = command.info->operand_count - 1U;
    const auto& operand = command.info->operand[last];
    const auto ms = command.value[last];
    const auto written = source_.text(command.span);
    const bool drives = is(command, MacroCommand::Roll);
    const bool said = written.find('=') != std::string_view::npos;
    if (operand.unit != spec::MacroUnit::Milliseconds || ms <= 0 || ms >= shortest_ms ||
        !is_digit(written.back()) || (operand.maximum <= UINT8_MAX && !drives && !said))
      return;
    const Span span{command.span.end - 1, command.span.end};
    auto& d = report(rules::ShortTime, span, texts::WithoutUnit(ms, ms),
                     texts::Write(fmt::format("{}s", written)));
    d.fix = single_fix(d.help, {span.end, span.end}, "s", Safety::Unsafe);
    if (operand.maximum > UINT8_MAX || drives)
      return;
    const auto statement = std::string(written.substr(0, written.find_last_of(" ,\t")));
    const auto wait = fmt::format("delay {}s", ms);
    const auto bare = statement.substr(0, statement.find_last_not_of(" ,\t") + 1);
    const auto line = line_of(command);
    d.help = texts::WriteTwo(bare, wait);
    d.fix =
        Fix{d.help,
            {{{command.span.begin + static_cast<std::uint32_t>(bare.size()), command.span.end}, {}},
             below(source_, line, indent_of(source_, line), wait)},
            Safety::Unsafe};
  }

  /// The one known id within a typo of the id in a command; empty if there is none or several. The
  /// macro's own id is excluded.
  std::string near_id(const PlacedCommand& command) const {
    const auto written = std::to_string(command.value[0]);
    std::string found;
    for (std::size_t other = spec::macro_id_user_first; other <= spec::macro_id_user_last;
         ++other) {
      const auto id = std::to_string(other);
      if (!known_[other] || other == around_->id || edit_distance(written, id) != 1)
        continue;
      if (!found.empty())
        return {};
      found = id;
    }
    return found;
  }

  /// A known id with the two digits swapped; empty if there is none.
  std::string turned_id(std::uint8_t id) const {
    const std::size_t turned = id % 10U * 10U + id / 10U;
    return turned >= spec::macro_id_user_first && known_[turned] ? std::to_string(turned)
                                                                 : std::string();
  }

  static std::string id_of(const PlacedCommand& command) {
    return fmt::format("id={}", command.value[0]);
  }

  void offer_id(Diagnostic& d, const PlacedCommand& command, const std::string& id) const {
    if (id.empty() || parse_number<int>(source_.text(command.operand)) != command.value[0])
      return;
    const auto line = fmt::format("{} {}", command.info->mnemonic, id);
    d.help = d.help.empty() ? texts::Write(line) : texts::WriteOrCheck(line, id_of(command));
    d.fix = single_fix(texts::Write(line), command.operand, id, Safety::Unsafe);
  }

  void check_target(const PlacedCommand& command) {
    const auto id = static_cast<std::uint8_t>(command.value[0]);
    switch (spec::macro_id_kind(id)) {
    case MacroIdKind::Stream:
      report(rules::StreamTarget, command.operand, texts::LeadsToStream(command.info->mnemonic, id),
             texts::IdsAre(spec::macro_id_user_first, spec::macro_id_user_last,
                           spec::macro_id_temporary));
      return;
    case MacroIdKind::None:
      if (command.info->command != MacroCommand::OnCollision)
        report(rules::UnknownTarget, command.operand, texts::ZeroIsNone(),
               texts::IdsAre(spec::macro_id_user_first, spec::macro_id_user_last,
                             spec::macro_id_temporary));
      return;
    case MacroIdKind::User:
      if (!known_[id])
        offer_id(report(rules::UnknownTarget, command.operand, texts::NoSuchId(id),
                        texts::CheckTogether(id_of(command))),
                 command, near_id(command));
      return;
    case MacroIdKind::System:
      if (const auto turned = turned_id(id); !known_[id] && !turned.empty())
        offer_id(report(rules::UnknownTarget, command.operand, texts::IdOfSystem(id)), command,
                 turned);
      return;
    case MacroIdKind::Temporary: return;
    }
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
      report(rules::HeapFull, macro.span,
             entries > spec::macro_heap_entries
                 ? texts::TooManyMacros(entries, spec::macro_heap_entries)
                 : texts::BeyondHeap(heap, spec::macro_heap_size),
             texts::RunAsTemporary());
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
      report(rules::CollisionsOff, asks->span, texts::NothingDetects(),
             texts::WriteAbove("configure_collision 1, 100, 50, 100, 50, 200ms"));
  }

  /// If the only roll has speed 0 and the ball is then stopped, speed and heading are swapped.
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
    const auto line = fmt::format("roll {}, 0{}", roll->value[1],
                                  roll->value[2] > 0 ? fmt::format(", {}ms", roll->value[2]) : "");
    report(rules::NeverRolls, roll->span, texts::BallNeverRolls(),
           texts::WriteBecause(line, texts::SpeedFirst()))
        .fix = single_fix(texts::Write(line), roll->span, line, Safety::Unsafe);
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
          report(rules::GosubDepth, inner.command->span, texts::GosubIgnored(), texts::OneLevel())
              .notes.push_back({outer.command->span, texts::CalledHere()});
          break;
        }
  }

  const Source& source_;
  const Assembly& assembly_;
  const LintOptions& options_;
  const Ids& known_;
  const AssembledMacro* around_ = nullptr; ///< the macro being checked
  std::vector<Diagnostic> diagnostics_;
};

/// Removes the findings allowed by remarks.
void silence(const Source& source, std::vector<Diagnostic>& diagnostics) {
  std::vector<AllowComment> comments;
  for (auto found = source.text().find(allow_mark); found != std::string_view::npos;
       found = source.text().find(allow_mark, found + allow_mark.size())) {
    const auto number = source.position(static_cast<std::uint32_t>(found)).line;
    const auto line = source.line(number);
    const auto remark = remark_of(line);
    const auto start = source.line_start(number);
    if (found < start + remark)
      continue; // inside a text
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

/// The words of macros, without those that differ from a constant only in case: beside a constant
/// `SPEED`, `speed` is not offered.
std::vector<std::string_view> all_words(const SurroundingText& elsewhere) {
  std::vector<std::string_view> words{".macro", ".const", ".raw", ".noend", "on",      "off",  "id",
                                      "flags",  "delay",  "time", "speed",  "heading", "angle"};
  for (const auto& row : spec::macro_commands)
    words.push_back(row.mnemonic);
  std::erase_if(words, [&](std::string_view word) {
    return std::any_of(
        elsewhere.names.begin(), elsewhere.names.end(),
        [&](const std::string& name) { return name != word && equal_words(name, word); });
  });
  return words;
}

/// Adds the corrected line to each error. What other files define stays defined.
void offer_lines(const Source& source, const Ids& known, const LintOptions& options,
                 std::vector<Diagnostic>& findings) {
  repair::Dialect dialect;
  dialect.language = repair::Language::Macro;
  dialect.parses = [](std::string_view line) { return parse(line).diagnostics.empty(); };
  const auto elsewhere = read_surroundings(source.text());
  dialect.words = all_words(elsewhere);
  dialect.rephrase = [&](const repair::Tokens& line) { return rephrase(line, elsewhere); };
  dialect.check = [&](std::string_view text) {
    const Source changed(source.name(), std::string(text));
    const auto assembly = assemble(changed);
    auto found = assembly.diagnostics;
    auto more = Linter(changed, assembly, options, known | ids_of(assembly)).run();
    silence(changed, more);
    found.insert(found.end(), more.begin(), more.end());
    return found;
  };
  repair::offer_lines(source.text(), dialect, findings);
  for (auto& one : findings) // `leg 0 500ms`
    if (one.rule == &rules::UnknownCommand && !one.fix)
      for (const auto& name : elsewhere.macros)
        if (source.text(one.span) == name)
          one.help = texts::MacroTakesNone(
              name, fmt::format("{} {}", spec::info(MacroCommand::Gosub).mnemonic, name));
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
