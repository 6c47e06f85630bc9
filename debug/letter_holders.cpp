#include "debug/letter_holders.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace orb::debug {
namespace {

using compiler::ItemKind;
using compiler::StatementNode;
using spec::Statement;

/// No assignment on any path so far: merges with any other state.
constexpr std::uint32_t untouched = structured::none - 1;

/// Data flow analysis: tracks what letters hold in a compiled program.
class Flow {
public:
  explicit Flow(const run::Program& program)
      : program_(program.parsed), robot_(program.compiled->robot) {
    for (std::uint32_t i = 0; i < program_.lines.size(); ++i)
      if (program_.lines[i].has_number() && program_.lines[i].has_statement()) {
        index_.emplace(program_.lines[i].number, lines_.size());
        lines_.push_back(i);
      }
    before_.resize(lines_.size());
    link();
  }

  std::map<std::uint32_t, Holders> run() {
    if (lines_.empty())
      return {};
    Holders start;
    start.fill(untouched);
    before_[0] = start;
    std::vector<std::size_t> work{0};
    while (!work.empty()) {
      const auto line = work.back();
      work.pop_back();
      const auto after = leave(line);
      for (const auto next : next_[line])
        if (merge(before_[next], after))
          work.push_back(next);
    }
    return result();
  }

private:
  const StatementNode& statement(std::size_t line) const {
    return program_.statements[program_.lines[lines_[line]].statement];
  }

  void link() {
    next_.resize(lines_.size());
    std::vector<std::size_t> returns;
    std::vector<std::size_t> after_calls;
    for (std::size_t line = 0; line < lines_.size(); ++line) {
      bool falls_through = true;
      for (const auto& one : program_.whole(statement(line))) {
        const bool always = &one == &statement(line);
        if (one.kind == Statement::Return)
          returns.push_back(line);
        const bool calls =
            one.kind == Statement::Gosub || one.spelling == compiler::Spelling::OnGosub;
        if (calls && line + 1 < lines_.size())
          after_calls.push_back(line + 1);
        for (const auto& item : program_.items_of(one))
          if (item.kind == ItemKind::Target)
            if (const auto found = index_.find(item.value); found != index_.end())
              next_[line].push_back(found->second);
        if (always && (calls || one.kind == Statement::Goto || one.kind == Statement::Return ||
                       one.kind == Statement::End || one.kind == Statement::On))
          falls_through = false;
        if (one.kind == Statement::Next)
          loops_.push_back(line);
      }
      if (falls_through && line + 1 < lines_.size())
        next_[line].push_back(line + 1);
    }
    for (const auto line : returns)
      next_[line].insert(next_[line].end(), after_calls.begin(), after_calls.end());
    link_loops();
  }

  /// A `next` jumps back to the line after any earlier `for` of its letter.
  void link_loops() {
    for (const auto line : loops_)
      for (std::size_t begin = 0; begin < line; ++begin)
        if (statement(begin).kind == Statement::For)
          next_[line].push_back(begin + 1);
  }

  /// The letters' contents after a line.
  Holders leave(std::size_t line) const {
    auto holders = *before_[line];
    const auto number = program_.lines[lines_[line]].number;
    for (const auto& one : program_.whole(statement(line)))
      for (const auto& item : program_.items_of(one))
        if (item.kind == ItemKind::Letter && item.value < letters)
          holders[item.value] = named(number, item.value);
    return holders;
  }

  /// The symbol that the line uses for the letter; none for a temporary.
  std::uint32_t named(std::uint32_t number, std::uint32_t letter) const {
    const auto found = std::lower_bound(
        robot_.lines.begin(), robot_.lines.end(), number,
        [](const structured::RobotLine& one, std::uint32_t wanted) { return one.number < wanted; });
    if (found != robot_.lines.end() && found->number == number)
      for (auto n = found->names_begin; n < found->names_end; ++n)
        if (robot_.names[n].letter == letter)
          return robot_.names[n].symbol;
    return structured::none;
  }

  static bool merge(std::optional<Holders>& into, const Holders& from) {
    if (!into) {
      into = from;
      return true;
    }
    bool changed = false;
    for (std::size_t i = 0; i < letters; ++i) {
      auto& held = (*into)[i];
      const auto merged = held == untouched                         ? from[i]
                          : from[i] == untouched || from[i] == held ? held
                                                                    : structured::none;
      changed = changed || merged != held;
      held = merged;
    }
    return changed;
  }

  /// Adds the names that a line itself reads.
  std::map<std::uint32_t, Holders> result() const {
    std::map<std::uint32_t, Holders> all;
    for (std::size_t line = 0; line < lines_.size(); ++line) {
      const auto number = program_.lines[lines_[line]].number;
      Holders holders;
      holders.fill(structured::none);
      if (before_[line])
        holders = *before_[line];
      std::replace(holders.begin(), holders.end(), untouched, structured::none);
      for (std::uint32_t letter = 0; letter < letters; ++letter)
        if (const auto name = named(number, letter);
            name != structured::none && holders[letter] == structured::none)
          holders[letter] = name;
      all.emplace(number, holders);
    }
    return all;
  }

  const compiler::Program& program_;
  const structured::RobotText& robot_;
  std::vector<std::uint32_t> lines_; ///< reachable lines, as indices into the program's
  std::map<std::uint32_t, std::size_t> index_;
  std::vector<std::vector<std::size_t>> next_;
  std::vector<std::size_t> loops_;
  std::vector<std::optional<Holders>> before_;
};

} // namespace

std::map<std::uint32_t, Holders> letter_holders(const run::Program& program) {
  return program.compiled ? Flow(program).run() : std::map<std::uint32_t, Holders>();
}

} // namespace orb::debug
