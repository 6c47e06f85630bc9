#include "assembler/lint/lint_timing.h"

#include "assembler/lint/edits.h"
#include "assembler/text/rules.h"
#include "assembler/text/texts.h"
#include "assembler/timing.h"
#include "assembler/walk.h"
#include "base/duration.h"
#include "base/fixes.h"
#include "spec/api.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace orb::assembler {
namespace {

using spec::MacroBackground;
using spec::MacroCommand;
using Origin = PlacedCommand::Origin;

bool rolls(MacroCommand kind) {
  return kind == MacroCommand::Roll || kind == MacroCommand::Roll2 ||
         kind == MacroCommand::RollSd1 || kind == MacroCommand::RollSpd1Sd1 ||
         kind == MacroCommand::RollSpd2Sd1;
}

class TimingLinter {
public:
  TimingLinter(const Source& source, const Assembly& assembly)
      : source_(source), assembly_(assembly) {}

  std::vector<Diagnostic> run() {
    std::vector<bool> led_to(assembly_.macros.size());
    for (const auto& macro : assembly_.macros)
      for (const auto& command : macro.commands)
        if (is(command, MacroCommand::Goto) || is(command, MacroCommand::Gosub))
          for (std::size_t i = 0; i < assembly_.macros.size(); ++i)
            if (&assembly_.macros[i] != &macro && assembly_.macros[i].id == command.value[0])
              led_to[i] = true;
    std::vector<bool> seen(assembly_.macros.size());
    for (std::size_t i = 0; i < assembly_.macros.size(); ++i)
      if (!led_to[i])
        follow(i, seen);
    for (std::size_t i = 0; i < assembly_.macros.size(); ++i)
      if (!seen[i])
        follow(i, seen);
    return std::move(diagnostics_);
  }

private:
  Diagnostic& report(const Rule& rule, Span span, Message message, Message help = {}) {
    diagnostics_.push_back(finding(rule, span, std::move(message), std::move(help)));
    return diagnostics_.back();
  }

  /// Returns false if the rule was already reported here: loops and callers visit a command
  /// repeatedly.
  bool first_time(const Rule& rule, Span span) {
    return reported_.insert({rule.id, span.begin}).second;
  }

  struct Background {
    const PlacedCommand* command = nullptr; ///< null: none is running
    std::int64_t begin_ms = 0;
    std::int64_t end_ms = 0;
    const PlacedCommand* wait = nullptr; ///< the only delay since then
    int waits = 0;
  };

  static std::string delay(std::int64_t ms) { return "delay " + time_text(ms); }

  void cut(const Background& background, std::int64_t now_ms, Span by, Message note) {
    if (background.command == nullptr || now_ms >= background.end_ms ||
        !first_time(rules::CutShort, background.command->span))
      return;
    auto& diagnostic =
        report(rules::CutShort, background.command->span,
               texts::NeedsMore(background.command->info->background == MacroBackground::Fade
                                    ? texts::Fade()
                                    : texts::Rotation(),
                                print_time(background.end_ms - background.begin_ms),
                                print_time(now_ms - background.begin_ms)),
               texts::AddAfter(delay(background.end_ms - now_ms)));
    lengthen(diagnostic, background, now_ms);
    if (by.size() > 0)
      diagnostic.notes.push_back({by, std::move(note)});
  }

  void write_below(Diagnostic& diagnostic, const PlacedCommand& command,
                   const std::string& line) const {
    const auto at = source_.position(command.span.begin).line;
    diagnostic.help = texts::WriteBelow(line);
    diagnostic.fix =
        Fix{texts::Write(line), {below(source_, at, indent_of(source_, at), line)}, Safety::Unsafe};
  }

  /// Proposes to lengthen the existing delay, or to add one.
  void lengthen(Diagnostic& diagnostic, const Background& background, std::int64_t now_ms) const {
    const auto& command = *background.command;
    const auto line = delay(background.end_ms - background.begin_ms);
    const bool ignored = background.wait != nullptr && rolls(background.wait->info->command) &&
                         command.info->background == MacroBackground::Rotate;
    if ((now_ms == background.begin_ms || ignored) && command.origin == Origin::Written) {
      write_below(diagnostic, command, line);
    } else if (background.waits == 1 && background.wait->origin == Origin::Written) {
      const auto span = background.wait->span;
      diagnostic.help = texts::WriteOnLine(line, source_.position(span.begin).line);
      diagnostic.fix = single_fix(texts::Write(line), span, line, Safety::Unsafe);
    }
  }

  /// Effects that continue while commands run.
  struct Ongoing {
    Background fade;
    Background rotation;
    Background roll;                             ///< the last drive command, with its time
    Background colour;                           ///< the last colour set
    const PlacedCommand* unstabilized = nullptr; ///< the command that switched stabilization off
  };

  void follow(std::size_t start, std::vector<bool>& seen) {
    seen[start] = true;
    Ongoing ongoing;
    const auto result = walk(assembly_, start, budget_, [&](const Visit& visit) {
      --budget_;
      seen[visit.macro] = true;
      const auto& command = assembly_.macros[visit.macro].commands[visit.command];
      if (command.info == nullptr || command.origin == Origin::Broken)
        return;
      check_roll(command, visit.latest_ms, ongoing);
      check_time(command, visit, ongoing);
      stabilize(command, ongoing);
      for (auto* background : {&ongoing.fade, &ongoing.rotation})
        if (background->command != nullptr && command.info->wait != spec::MacroWait::None &&
            wait_of(command, visit.sd1_ms, visit.sd2_ms).most_ms > 0)
          background->waits += std::exchange(background->wait, &command) != &command ||
                                       !is(command, MacroCommand::Delay)
                                   ? is(command, MacroCommand::Delay) ? 1 : 2
                                   : 0;
      begin_background(command, visit, ongoing);
      if (command.info->command == MacroCommand::Gosub && !defines(command.value[0]))
        ongoing = {}; // the callee is unknown
    });
    if (result.end != WalkEnd::Ended && result.end != WalkEnd::Sleeps)
      return;
    cut(ongoing.fade, result.latest_ms, {}, {});
    if (stops_at_end(assembly_.macros[start]))
      replaced(ongoing.roll, result.latest_ms, {}, texts::RollEnds());
    cut(ongoing.rotation, result.latest_ms, {}, {});
  }

  static bool stops_at_end(const AssembledMacro& macro) {
    return spec::has_flag(macro.flags.value_or(spec::macro_default_flags),
                          spec::MacroFlag::MotorControl);
  }

  /// Reports a roll or a colour that is replaced at once.
  void replaced(const Background& first, std::int64_t now_ms, Span by, Message message) {
    if (first.command == nullptr || now_ms > first.begin_ms ||
        !first_time(rules::NoTime, first.command->span))
      return;
    auto& diagnostic =
        report(rules::NoTime, first.command->span, std::move(message), texts::AddDelay("delay 1s"));
    last_as_others(diagnostic, *first.command);
    if (by.size() > 0)
      diagnostic.notes.push_back({by, texts::ReplacedHere()});
  }

  static bool is_alike(const PlacedCommand& a, const PlacedCommand& b) {
    return a.info != nullptr && b.info != nullptr &&
           (rolls(a.info->command) ? rolls(b.info->command) && b.value[0] > 0
                                   : a.info->command == b.info->command);
  }

  /// If all others of its kind last equally long, proposes the same for this one.
  void last_as_others(Diagnostic& diagnostic, const PlacedCommand& command) const {
    std::vector<std::int64_t> times;
    for (const auto& macro : assembly_.macros)
      for (std::size_t i = 0; i + 1 < macro.commands.size(); ++i) {
        const auto& other = macro.commands[i];
        if (&other == &command || !is_alike(command, other))
          continue;
        const auto own = wait_of(other, 0, 0).most_ms;
        const auto& next = macro.commands[i + 1];
        times.push_back(own > 0 ? own : is(next, MacroCommand::Delay) ? next.value[0] : 0);
      }
    constexpr std::size_t enough = 2;
    std::erase(times, 0);
    if (times.size() < enough || command.origin != Origin::Written ||
        std::any_of(times.begin(), times.end(), [&](auto time) { return time != times[0]; }))
      return;
    write_below(diagnostic, command, delay(times[0]));
  }

  void check_time(const PlacedCommand& command, const Visit& visit, Ongoing& ongoing) {
    const auto kind = command.info->command;
    const auto now = visit.latest_ms;
    const bool has_speed = kind != MacroCommand::SetSpeed && command.value[0] > 0;
    if (rolls(kind) || kind == MacroCommand::SetSpeed) {
      replaced(ongoing.roll, now, command.span, texts::RollReplaced());
      ongoing.roll = has_speed ? Background{&command, now, now} : Background{};
    }
    if (kind == MacroCommand::Rgb || kind == MacroCommand::RgbSd2) {
      replaced(ongoing.colour, now, command.span, texts::ColourReplaced());
      ongoing.colour = {&command, now, now};
    }
  }

  /// Proposes a missing line above a command.
  Diagnostic& before_it(Diagnostic& diagnostic, const PlacedCommand& command,
                        const std::string& line) const {
    diagnostic.help = texts::AddBefore(line);
    if (command.origin == Origin::Written)
      diagnostic.fix = Fix{texts::Add(line),
                           {above(source_, source_.position(command.span.begin).line, line)},
                           Safety::Unsafe};
    return diagnostic;
  }

  void check_roll(const PlacedCommand& command, std::int64_t now, const Ongoing& ongoing) {
    const auto kind = command.info->command;
    const auto& rotation = ongoing.rotation;
    if (rolls(kind) && rotation.command != nullptr && now < rotation.end_ms &&
        first_time(rules::RollDuringRotation, command.span))
      before_it(report(rules::RollDuringRotation, command.span, texts::RollIgnored()), command,
                delay(rotation.end_ms - now))
          .notes.push_back({rotation.command->span, texts::RotationBegins()});
    if ((rolls(kind) || kind == MacroCommand::SetSpeed) && ongoing.unstabilized != nullptr &&
        first_time(rules::RollUnstabilized, command.span))
      before_it(
          report(rules::RollUnstabilized, command.span, texts::NoEffect(command.info->mnemonic)),
          command, "stabilization on")
          .notes.push_back({ongoing.unstabilized->span, texts::SwitchedOff()});
  }

  static void stabilize(const PlacedCommand& command, Ongoing& ongoing) {
    const auto kind = command.info->command;
    if (kind == MacroCommand::Stabilization)
      ongoing.unstabilized = command.value[0] == 0 ? &command : nullptr;
    if (kind == MacroCommand::RawMotors && (command.value[0] != spec::motor_mode::ignore ||
                                            command.value[2] != spec::motor_mode::ignore))
      ongoing.unstabilized = &command;
  }

  void begin_background(const PlacedCommand& command, const Visit& visit, Ongoing& ongoing) {
    const auto kind = command.info->command;
    const auto now = visit.latest_ms;
    if (kind == MacroCommand::Rgb || kind == MacroCommand::RgbSd2) {
      cut(ongoing.fade, now, command.span, texts::OtherColour());
      ongoing.fade = {};
    }
    if (command.info->background == MacroBackground::Fade) {
      cut(ongoing.fade, now, command.span, texts::NextBegins());
      ongoing.fade = {&command, now, now + command.value[3]};
    }
    if (command.info->background == MacroBackground::Rotate) {
      cut(ongoing.rotation, now, command.span, texts::NextBegins());
      const auto time = kind == MacroCommand::Rotate      ? command.value[1]
                        : kind == MacroCommand::RotateSd1 ? visit.sd1_ms
                                                          : visit.sd2_ms;
      ongoing.rotation = {&command, now, now + time};
    }
  }

  bool defines(std::int32_t id) const {
    return std::any_of(assembly_.macros.begin(), assembly_.macros.end(),
                       [&](const AssembledMacro& macro) {
                         return macro.id.value_or(spec::macro_id_temporary) == id;
                       });
  }

  const Source& source_;
  const Assembly& assembly_;
  std::vector<Diagnostic> diagnostics_;
  std::set<std::pair<std::string_view, std::uint32_t>> reported_;
  std::size_t budget_ = longest_walk; ///< commands left to follow, over all macros
};

} // namespace

bool is(const PlacedCommand& command, MacroCommand kind) {
  return command.info != nullptr && command.origin != Origin::Broken &&
         command.info->command == kind;
}

std::vector<Diagnostic> lint_timing(const Source& source, const Assembly& assembly) {
  return TimingLinter(source, assembly).run();
}

} // namespace orb::assembler
