#include "compiler/lint/lint_passes.h"

#include "base/text/text.h"
#include "compiler/text/rules.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::compiler {
namespace {

constexpr std::uint32_t step = 10;

class MissingNumbers {
public:
  MissingNumbers(const Program& program, std::span<const Fault* const> faults, Findings& findings)
      : program_(program), faults_(faults), findings_(findings) {}

  void run() {
    const bool none_at_all = std::none_of(program_.lines.begin(), program_.lines.end(),
                                          [](const Line& line) { return line.has_number(); });
    if (none_at_all && faults_.size() > 1)
      number_all();
    else
      number_some();
  }

private:
  std::string_view text_of(const Fault& fault) const {
    const auto& line = program_.lines[fault.line];
    const auto end = line.comment.size() > 0 ? line.comment.begin : line.span.end;
    return program_.text_of({fault.span.begin, end});
  }
  static Edit number(const Fault& fault, std::uint32_t number) {
    return {{fault.span.begin, fault.span.begin}, fmt::format("{} ", number)};
  }

  void number_all() {
    auto& d =
        findings_.add(rules::MissingLineNumber, faults_[0]->span, texts::NoLineHasNumber(),
                      texts::CommandNumbersAll(fmt::format("{} {}", step, text_of(*faults_[0])),
                                               "orb check --fix"));
    if (faults_.size() * step > static_cast<std::size_t>(greatest))
      return;
    const bool words = std::all_of(faults_.begin(), faults_.end(), [this](const Fault* fault) {
      return is_letter(text_of(*fault).front()); // and no number after a sign: `> 10 LEDC 1`
    });
    d.fix = Fix{texts::NumberTheLines(), {}, words ? Safety::Safe : Safety::Unsafe};
    for (std::size_t i = 0; i < faults_.size(); ++i)
      d.fix->edits.push_back(number(*faults_[i], static_cast<std::uint32_t>(i + 1) * step));
  }

  /// Numbers the lines between numbered ones with free numbers that no jump uses.
  void number_some() {
    for (std::size_t i = 0; i < faults_.size();) {
      auto last = i + 1;
      const auto above = number_below_in_text(faults_[i]->line);
      while (last < faults_.size() && number_below_in_text(faults_[last]->line).line == above.line)
        ++last;
      number_run(faults_.subspan(i, last - i), above.number);
      i = last;
    }
  }

  struct Below {
    std::uint32_t line;
    std::uint32_t number;
  };
  /// The first numbered line below.
  Below number_below_in_text(std::uint32_t line) const {
    while (line < program_.lines.size() && !program_.lines[line].has_number())
      ++line;
    return {line, line < program_.lines.size() ? program_.lines[line].number : greatest + 1};
  }

  void number_run(std::span<const Fault* const> run, std::uint32_t above) {
    std::uint32_t below = 0;
    for (auto line = run[0]->line; line > 0 && below == 0; --line)
      below = program_.lines[line - 1].has_number() ? program_.lines[line - 1].number : 0;
    const auto room =
        above > below ? (above - below) / (static_cast<std::uint32_t>(run.size()) + 1) : 0;
    for (std::size_t i = 0; i < run.size(); ++i) {
      auto& d = findings_.add(
          rules::MissingLineNumber, run[i]->span,
          texts::Found(texts::Expected(texts::ALineNumber()), program_.text_of(run[i]->span)),
          texts::LinesBeginWithNumber(greatest));
      auto free = below + std::min(room, step) * static_cast<std::uint32_t>(i + 1);
      if (const auto named = named_between(below, above); run.size() == 1 && named.size() == 1)
        free = named[0]; // a jump into the gap means this line
      else if (room == 0 || is_named(free))
        continue;
      d.help = texts::Write(fmt::format("{} {}", free, text_of(*run[i])));
      d.fix = Fix{texts::NumberTheLine(free), {number(*run[i], free)}, Safety::Safe};
    }
  }

  /// The numbers between two lines that jumps use, each once.
  std::vector<std::uint32_t> named_between(std::uint32_t below, std::uint32_t above) const {
    std::vector<std::uint32_t> named;
    for (const auto& item : program_.items)
      if (item.kind == ItemKind::Target && below < item.value && item.value < above &&
          std::find(named.begin(), named.end(), item.value) == named.end())
        named.push_back(item.value);
    return named;
  }

  bool is_named(std::uint32_t number) const {
    return std::any_of(program_.items.begin(), program_.items.end(), [&](const Item& item) {
      return item.kind == ItemKind::Target && item.value == number;
    });
  }

  static constexpr auto greatest =
      static_cast<std::uint32_t>(spec::value_of(spec::Limit::GreatestLineNumber));

  const Program& program_;
  std::span<const Fault* const> faults_;
  Findings& findings_;
};

} // namespace

void lint_missing_numbers(const Program& program, std::span<const Fault* const> faults,
                          Findings& findings) {
  if (!faults.empty())
    MissingNumbers(program, faults, findings).run();
}

} // namespace orb::compiler
