#include "testing/verdicts/table.h"

#include "testing/texts.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace orb::testing {

bool ToldOnce::is_new(const GroupResult& group, const CaseResult& failure) {
  return failure.verdict != Verdict::Error ||
         programs_.insert(group.program + "\n" + failure.problem).second;
}

Table whole_table(const Results& results) {
  using Key = std::pair<std::string, std::string>;
  Table table;
  std::map<Key, std::size_t> columns;
  std::map<std::string, std::size_t> rows;
  std::map<std::string, std::string> file_of; // by name of the test, if only one file has it
  for (const auto& group : results.groups) {
    const auto [known, fresh] = file_of.try_emplace(group.test, group.file);
    if (!fresh && known->second != group.file)
      known->second.clear();
  }
  for (const auto& group : results.groups) {
    const auto [column, new_test] =
        columns.try_emplace({group.file, group.test}, table.tests.size());
    if (new_test)
      table.tests.push_back(
          file_of[group.test].empty() ? fmt::format("{}: {}", group.file, group.test) : group.test);
    const auto [row, new_program] = rows.try_emplace(group.program, table.rows.size());
    if (new_program)
      table.rows.push_back({group.program, {}, 0, 0});
    auto& cells = table.rows[row->second].cells;
    cells.resize(std::max(cells.size(), column->second + 1));
    cells[column->second] = &group;
  }
  for (auto& row : table.rows) {
    row.cells.resize(table.tests.size());
    for (const auto* cell : row.cells)
      if (cell != nullptr) {
        row.points_of += cell->points;
        row.points += cell->verdict() == Verdict::Passed ? cell->points : 0;
      }
  }
  return table;
}

Table table_of(const Results& results) {
  auto table = whole_table(results);
  if (table.rows.size() < 2 ||
      results.groups.size() <= table.tests.size()) // each test has a single program
    table.rows.clear();
  return table;
}

std::string failed_seeds(const GroupResult& group, const Say& say, std::size_t longest) {
  struct Range {
    std::uint64_t first;
    std::uint64_t last;
  };
  std::vector<Range> ranges;
  for (const auto& one : group.cases) {
    if (one.verdict == Verdict::Passed)
      continue;
    if (ranges.empty() || one.seed != ranges.back().last + 1)
      ranges.push_back({one.seed, one.seed});
    ranges.back().last = one.seed;
  }
  std::string text;
  std::size_t length = 0;
  const auto tell = [&](const Message& seeds) {
    length += in_english(seeds).size() + (text.empty() ? 0 : 2);
    if (length <= longest)
      text += (text.empty() ? "" : ", ") + say(seeds);
    return length <= longest;
  };
  const auto seed = [](std::uint64_t number) { return Message::as_is(std::to_string(number)); };
  for (const auto& [first, last] : ranges) {
    const bool is_told = last > first + 1
                             ? tell(texts::Seeds(first, last))
                             : tell(seed(first)) && (last == first || tell(seed(last)));
    if (!is_told)
      return text + ", …";
  }
  return text;
}

const CaseResult* first_failure(const GroupResult& group) {
  const auto found =
      std::find_if(group.cases.begin(), group.cases.end(),
                   [](const CaseResult& one) { return one.verdict != Verdict::Passed; });
  return found == group.cases.end() ? nullptr : &*found;
}

} // namespace orb::testing
