#include "assembler/lint_timing.h"

#include "assembler/rules.h"
#include "assembler/timing.h"
#include "assembler/walk.h"
#include "spec/api.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
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
  explicit TimingLinter(const Assembly& assembly) : assembly_(assembly) {}

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
  Diagnostic& report(const Rule& rule, Span span, std::string message, std::string help = {}) {
    diagnostics_.push_back(finding(rule, span, std::move(message), std::move(help)));
    return diagnostics_.back();
  }

  /// False where the rule was reported there already: loops and callers come by more than once.
  bool first_time(const Rule& rule, Span span) {
    return reported_.insert({rule.id, span.begin}).second;
  }

  struct Background {
    const PlacedCommand* command = nullptr; ///< null: none runs
    std::int64_t begin_ms = 0;
    std::int64_t end_ms = 0;
  };

  void cut(const Background& background, std::int64_t now_ms, Span by, std::string_view what) {
    if (background.command == nullptr || now_ms >= background.end_ms ||
        !first_time(rules::CutShort, background.command->span))
      return;
    auto& diagnostic = report(
        rules::CutShort, background.command->span,
        fmt::format("this {} needs {} but has {}",
                    background.command->info->background == MacroBackground::Fade ? "fade"
                                                                                  : "rotation",
                    print_time(background.end_ms - background.begin_ms),
                    print_time(now_ms - background.begin_ms)),
        fmt::format("add `delay {}` after it", background.end_ms - now_ms));
    if (by.size() > 0)
      diagnostic.notes.push_back({by, fmt::format("{} here", what)});
  }

  /// What goes on while commands run.
  struct Ongoing {
    Background fade;
    Background rotation;
    Background roll;   ///< the last one that drives, with the time when it was told
    Background colour; ///< the last one that was set
    const PlacedCommand* unstabilized = nullptr; ///< what switched stabilization off
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
      begin_background(command, visit, ongoing);
      if (command.info->command == MacroCommand::Gosub && !defines(command.value[0]))
        ongoing = {}; // who knows what happens there
    });
    if (result.end != WalkEnd::Ended && result.end != WalkEnd::Sleeps)
      return;
    cut(ongoing.fade, result.latest_ms, {}, {});
    if (stops_at_end(assembly_.macros[start]))
      replaced(ongoing.roll, result.latest_ms, {}, "roll");
    cut(ongoing.rotation, result.latest_ms, {}, {});
  }

  static bool stops_at_end(const AssembledMacro& macro) {
    return spec::has_flag(macro.flags.value_or(spec::macro_default_flags),
                          spec::MacroFlag::MotorControl);
  }

  /// A roll or a colour that lasts for no time.
  void replaced(const Background& first, std::int64_t now_ms, Span by, std::string_view what) {
    if (first.command == nullptr || now_ms > first.begin_ms ||
        !first_time(rules::NoTime, first.command->span))
      return;
    auto& diagnostic = report(rules::NoTime, first.command->span,
                              fmt::format("this {} has no time: {}", what,
                                          by.size() > 0 ? "the next one replaces it at once"
                                                        : "the macro ends, and stops the motors"),
                              "write `delay 1s` below");
    if (by.size() > 0)
      diagnostic.notes.push_back({by, "replaced here"});
  }

  void check_time(const PlacedCommand& command, const Visit& visit, Ongoing& ongoing) {
    const auto kind = command.info->command;
    const auto now = visit.latest_ms;
    const bool has_speed = kind != MacroCommand::SetSpeed && command.value[0] > 0;
    if (rolls(kind) || kind == MacroCommand::SetSpeed) {
      replaced(ongoing.roll, now, command.span, "roll");
      ongoing.roll = has_speed ? Background{&command, now, now} : Background{};
    }
    if (kind == MacroCommand::Rgb || kind == MacroCommand::RgbSd2) {
      replaced(ongoing.colour, now, command.span, "colour");
      ongoing.colour = {&command, now, now};
    }
  }

  void check_roll(const PlacedCommand& command, std::int64_t now, const Ongoing& ongoing) {
    const auto kind = command.info->command;
    const auto& rotation = ongoing.rotation;
    if (rolls(kind) && rotation.command != nullptr && now < rotation.end_ms &&
        first_time(rules::RollDuringRotation, command.span))
      report(rules::RollDuringRotation, command.span,
             "this roll is ignored: a rotation is still in progress",
             fmt::format("add `delay {}` before it", rotation.end_ms - now))
          .notes.push_back({rotation.command->span, "the rotation begins here"});
    if ((rolls(kind) || kind == MacroCommand::SetSpeed) && ongoing.unstabilized != nullptr &&
        first_time(rules::RollUnstabilized, command.span))
      report(rules::RollUnstabilized, command.span,
             fmt::format("`{}` has no effect while stabilization is off", command.info->mnemonic),
             "add `stabilization on` before it")
          .notes.push_back({ongoing.unstabilized->span, "switched off here"});
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
      cut(ongoing.fade, now, command.span, "another colour is set here");
      ongoing.fade = {};
    }
    if (command.info->background == MacroBackground::Fade) {
      cut(ongoing.fade, now, command.span, "the next one begins");
      ongoing.fade = {&command, now, now + command.value[3]};
    }
    if (command.info->background == MacroBackground::Rotate) {
      cut(ongoing.rotation, now, command.span, "the next one begins");
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

  const Assembly& assembly_;
  std::vector<Diagnostic> diagnostics_;
  std::set<std::pair<std::string_view, std::uint32_t>> reported_;
  std::size_t budget_ = longest_walk; ///< commands to follow yet, all macros together
};

} // namespace

bool is(const PlacedCommand& command, MacroCommand kind) {
  return command.info != nullptr && command.origin != Origin::Broken &&
         command.info->command == kind;
}

std::vector<Diagnostic> lint_timing(const Assembly& assembly) {
  return TimingLinter(assembly).run();
}

} // namespace orb::assembler
