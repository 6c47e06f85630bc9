#include "mutants/faults.h"

#include "run/run.h"

#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <optional>

namespace mutants {
namespace {

/// Ignores events: the ending says enough.
class Deaf : public orb::run::Listener {
public:
  void on_event(orb::Duration, const orb::vm::Event&) override {}
  void on_fault(orb::Duration, const orb::run::ProgramError&) override {}
};

/// Returns the fault that stops a program; nothing if there is none.
std::optional<orb::run::ProgramError> fault_of(orb::run::Input input) {
  constexpr auto long_enough = std::chrono::seconds(20); // enough for two rounds of any example
  std::vector<orb::run::Input> inputs;
  inputs.push_back(std::move(input));
  orb::run::Options options;
  options.bound = long_enough;
  Deaf nobody;
  const auto ending = orb::run::run(inputs, options, nobody, nullptr);
  if (!ending || ending->faults.empty())
    return std::nullopt;
  return ending->faults.front();
}

} // namespace

void Faults::judge(const std::string& name, slips::Language language, const slips::Lines& mutant,
                   std::size_t at) {
  const auto nth = static_cast<std::size_t>(language);
  auto& count = counts_[nth];
  ++count.mutants;
  const auto text = slips::join(mutant);
  orb::structured::NoFiles files;
  auto input =
      orb::run::read_input(fmt::format("mutant.{}", slips::endings[nth]), text, {}, {}, files);
  if (!input || input->has_errors() || !input->program || !input->program->parsed.faults.empty()) {
    ++count.errors;
    return;
  }
  const auto fault = fault_of(std::move(*input));
  if (!fault)
    return;
  ++count.faults;
  const orb::Source source("mutant", text);
  std::size_t said = 0;
  std::size_t there = 0;
  for (const auto& found : slips::findings(language, text))
    if (found.severity != orb::Severity::Info) {
      ++said;
      there += source.position(found.span.begin).line == fault->place.line ? 1 : 0;
    }
  count.away += there == 0 ? 1 : 0;
  count.nothing += said == 0 ? 1 : 0;
  if (said > 0)
    return;
  const auto stopped = fault->place.line > 0 ? mutant[fault->place.line - 1] : std::string();
  silent_.push_back(fmt::format("{}:{}: {}\n  stops at {}: {} ({})\n", name, at + 1, mutant[at],
                                fault->place.line, stopped, fault->cause.seen));
}

std::size_t Faults::count() const {
  std::size_t all = 0;
  for (const auto& one : counts_)
    all += one.faults;
  return all;
}

void Faults::report() const {
  std::cout << "| language | mutants | with errors | stopped by a fault | nothing said there | "
               "nothing at all |\n"
               "|---|--:|--:|--:|--:|--:|\n";
  for (std::size_t i = 0; i < counts_.size(); ++i)
    if (const auto& c = counts_[i]; c.mutants > 0)
      std::cout << fmt::format("| `.{}` | {} | {} | {} | {} | {} |\n", slips::endings[i], c.mutants,
                               c.errors, c.faults, c.away, c.nothing);
  for (const auto& one : silent_)
    std::cout << one;
}

} // namespace mutants
