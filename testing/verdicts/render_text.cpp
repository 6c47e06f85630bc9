#include "base/text/utf8.h"
#include "testing/texts.h"
#include "testing/verdicts/render.h"
#include "testing/verdicts/table.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace orb::testing {
namespace {

// Characters. A wider table numbers its tests and lists them below.
constexpr std::size_t widest_table = 100;
constexpr std::size_t longest_seeds = 60;

/// Puts `before` in front of each line.
std::string indented(std::string_view text, std::string_view before) {
  std::string out;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    out += fmt::format("{}{}\n", before, text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

std::string padded(std::string_view text, std::size_t width) {
  const auto taken = code_points(text);
  return std::string(text) + std::string(width > taken ? width - taken : 0, ' ');
}

/// Pads words of a language to the width of the widest.
template <std::size_t N>
std::array<std::string, N> aligned(const std::array<Message, N>& words, const Say& say) {
  std::array<std::string, N> said;
  std::size_t width = 0;
  for (std::size_t i = 0; i < N; ++i) {
    said[i] = say(words[i]);
    width = std::max(width, code_points(said[i]));
  }
  for (auto& word : said)
    word = padded(word, width);
  return said;
}

/// The word of a verdict, made to stand out.
std::string verdict_words(Verdict verdict, Style style, const Say& say) {
  const auto words = aligned<3>({texts::Ok(), texts::LoudFail(), texts::LoudError()}, say);
  return style.paint(verdict == Verdict::Passed ? Role::Good : Role::Error,
                     words[static_cast<std::size_t>(verdict)]);
}

std::string details(const GroupResult& group, const CaseResult& one, Style style, const Say& say) {
  std::string out;
  if (one.verdict == Verdict::Error)
    return indented(to_terminal_text(one.problem), "  ");
  const auto [seen, ran, rerun] = aligned<3>({texts::Seen(), texts::Ran(), texts::Rerun()}, say);
  for (const auto& miss : one.misses) {
    out += fmt::format("  {}:{}: {}\n", shown_name(group.file), miss.line,
                       style.paint(Role::Bold, miss.expected));
    out += fmt::format("    {} {}\n", seen, say(miss.seen));
    if (!miss.where.empty())
      out += fmt::format("    {} {}\n", ran, to_printable(miss.where));
  }
  if (!one.again.empty())
    out += fmt::format("    {} {}\n", rerun, shown_name(one.again));
  return out;
}

/// What follows the name of a test: the program, the number of runs, the seeds.
std::string about(const GroupResult& group, bool with_program, const Say& say) {
  std::string out = with_program ? fmt::format(", {}", shown_name(group.program)) : std::string();
  const auto failed = static_cast<std::uint64_t>(
      std::count_if(group.cases.begin(), group.cases.end(),
                    [](const CaseResult& one) { return one.verdict != Verdict::Passed; }));
  if (group.cases.size() < 2)
    return group.cases.empty() || group.cases.front().seed == 1
               ? out
               : fmt::format("{}, {}", out, say(texts::Seed(group.cases.front().seed)));
  if (failed == 0)
    return fmt::format("{}, {}", out, say(counted(group.cases.size(), texts::OneRun, texts::Runs)));
  if (group.verdict() == Verdict::Error)
    return out;
  const auto& row = failed == 1 ? texts::FailedRun : texts::FailedRuns;
  return fmt::format("{}, {}", out,
                     say(row(failed, group.cases.size(), failed_seeds(group, say, longest_seeds))));
}

Message cell_text(const GroupResult* cell) {
  if (cell == nullptr || cell->cases.empty())
    return {};
  switch (cell->verdict()) {
  case Verdict::Passed: return texts::Ok();
  case Verdict::Failed: return texts::LoudFail();
  case Verdict::Error: return texts::Error();
  }
  return {};
}

std::string draw(const Table& table, Style style, const Say& say) {
  const auto program = say(texts::Program());
  auto first = code_points(program);
  const std::size_t narrowest =
      std::max({code_points(texts::Error.english), code_points(say(texts::LoudFail())),
                code_points(say(texts::Error()))});
  for (const auto& row : table.rows)
    first = std::max(first, code_points(shown_name(row.program)));
  auto heads = table.tests;
  for (auto& head : heads)
    head = to_printable(say(Message::as_is(head)));
  std::size_t width = first;
  for (const auto& head : heads)
    width += 2 + std::max(code_points(head), narrowest);
  const bool numbered = width + 10 > widest_table;
  for (std::size_t i = 0; numbered && i < heads.size(); ++i)
    heads[i] = std::to_string(i + 1);

  std::string out = style.paint(Role::Bold, padded(program, first));
  for (const auto& head : heads)
    out += "  " + style.paint(Role::Bold, padded(head, narrowest));
  out += "  " + style.paint(Role::Bold, say(texts::Points())) + "\n";
  for (const auto& row : table.rows) {
    out += padded(shown_name(row.program), first);
    for (std::size_t i = 0; i < heads.size(); ++i) {
      const auto text =
          padded(say(cell_text(row.cells[i])), std::max(narrowest, code_points(heads[i])));
      const bool good = row.cells[i] == nullptr || row.cells[i]->verdict() == Verdict::Passed;
      out += "  " + style.paint(good ? Role::Good : Role::Error, text);
    }
    out += fmt::format("  {}/{}\n", row.points, row.points_of);
  }
  for (std::size_t i = 0; numbered && i < heads.size(); ++i)
    out += fmt::format("{}: {}\n", i + 1, to_printable(say(Message::as_is(table.tests[i]))));
  return out;
}

/// Names those who handed in nothing.
std::string missing_words(const Results& results, const Say& say) {
  auto text = say(texts::WithoutProgram()) + " ";
  for (std::size_t i = 0; i < results.missing.size(); ++i)
    text += (i == 0 ? "" : ", ") + shown_name(results.missing[i]);
  return text;
}

} // namespace

std::string render_text(const Results& results, Listing listing, Style style, const Say& say) {
  const auto table = table_of(results);
  const bool many = !table.rows.empty();
  std::string out;
  ToldOnce told;
  for (const auto& group : results.groups) {
    if (group.cases.empty())
      continue;
    const auto* failure = first_failure(group);
    if (failure == nullptr && (listing == Listing::Failures || many))
      continue;
    const bool is_new = failure == nullptr || told.is_new(group, *failure);
    const auto verdict = verdict_words(group.verdict(), style, say);
    if (many && failure != nullptr && failure->verdict == Verdict::Error) {
      if (is_new)
        out += fmt::format("{} {}\n", verdict, shown_name(group.program)) +
               details(group, *failure, style, say);
      continue;
    }
    out += fmt::format("{} {}:{}: {}{}\n", verdict, shown_name(group.file), group.line,
                       to_printable(say(Message::as_is(group.test))), about(group, many, say));
    if (failure != nullptr && is_new)
      out += details(group, *failure, style, say);
  }
  if (many)
    out += (out.empty() ? "" : "\n") + draw(table, style, say);
  if (!results.missing.empty())
    out += missing_words(results, say) + "\n";
  return out + render_summary(results, say) + "\n";
}

std::string render_summary(const Results& results, const Say& say) {
  const auto totals = totals_of(results);
  if (totals.cases == 0)
    return say(results.cases == 0 ? texts::NoTests() : texts::NoCases());
  auto out = say(totals.tests == 1 ? texts::PassedOfOne(totals.tests_passed)
                                   : texts::PassedOf(totals.tests_passed, totals.tests));
  if (totals.points_of != static_cast<std::int64_t>(totals.tests))
    out += ", " + say(texts::PointsOf(totals.points, totals.points_of));
  if (totals.cases != totals.tests)
    out += ", " + say(texts::RunsOf(totals.cases - totals.failed, totals.cases));
  return out;
}

} // namespace orb::testing
