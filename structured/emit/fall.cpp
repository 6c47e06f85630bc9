#include "structured/emit/fall.h"

#include "structured/analyse/flow.h"
#include "structured/analyse/ranges.h"
#include "structured/analyse/sizes.h"
#include "structured/optimise/jumps.h"

#include <vector>

namespace orb::structured {
namespace {

class Faller {
public:
  explicit Faller(Code& code) : code_(code), at_(lines_of_labels(code)) {}

  void run() {
    for (std::uint32_t i = 1; i < code_.lines.size(); ++i)
      if ((is(i, LineKind::Goto) || is(i, LineKind::Return)) && is(after(i + 1), LineKind::If))
        fall(i);
  }

private:
  bool is(std::uint32_t i, LineKind kind) const {
    return i < code_.lines.size() && code_.lines[i].kind == kind;
  }

  /// The first line from here on that does something.
  std::uint32_t after(std::uint32_t i) const {
    while (is(i, LineKind::Label) || is(i, LineKind::Nothing))
      ++i;
    return i;
  }

  /// Takes out a jump if the tests below it lead to where it leads: one test instead of the jump,
  /// or a few where the line above can then stand in the test above that.
  void fall(std::uint32_t jump) {
    constexpr std::size_t most_tests = 3;
    const bool folds = jump >= 2 && fits_arm(code_.lines[jump - 1]) && is(jump - 2, LineKind::If) &&
                       !code_.lines[jump - 2].guard &&
                       after(at_[code_.lines[jump - 2].label]) == after(jump + 1);
    const bool returns = is(jump, LineKind::Return);
    const auto target = returns ? none : after(at_[code_.lines[jump].label]);
    find_known(jump);
    std::vector<Relation*> passed;
    auto i = after(jump + 1);
    while (i != target && !(returns && is(i, LineKind::Return))) {
      if (!is(i, LineKind::If) || code_.lines[i].guard || at_[code_.lines[i].label] == none ||
          passed.size() == (folds ? most_tests : 1))
        return;
      auto& condition = code_.conditions[code_.lines[i].condition];
      const auto outcome =
          condition.glue == Glue::None ? outcome_of(condition.first) : Outcome::Unknown;
      if (outcome == Outcome::Unknown)
        return;
      passed.push_back(&condition.first);
      i = after(outcome == Outcome::Always ? at_[code_.lines[i].label] : i + 1);
    }
    for (auto* relation : passed) // it is run for other values, too
      relation->left_range = relation->right_range = {};
    code_.lines[jump].kind = LineKind::Nothing;
  }

  /// What the lines right above a jump test and set, as long as it stays so.
  void find_known(std::uint32_t jump) {
    known_.clear();
    for (auto i = jump; i-- > 0 && falls_through(code_.lines[i]) && !is(i, LineKind::Label) &&
                        !is(i, LineKind::Gosub);) {
      const auto& line = code_.lines[i];
      Relation relation;
      if (line.kind == LineKind::Let && code_.is_number(line.term)) {
        relation.left = code_.read(line.variable);
        relation.right = line.term;
      } else if (line.kind == LineKind::If && code_.conditions[line.condition].glue == Glue::None) {
        relation = code_.conditions[line.condition].first;
        relation.comparison = opposite(relation.comparison);
      }
      if (relation.left != none && code_.terms[relation.left].effects == 0 &&
          code_.is_number(relation.right) && stays(relation.left, i + 1, jump))
        known_.push_back(relation);
    }
  }

  bool stays(std::uint32_t term, std::uint32_t from, std::uint32_t to) const {
    bool good = true;
    for (auto i = from; i < to; ++i)
      each_write(code_, code_.lines[i], [&](std::uint32_t set) {
        each_read(code_, term, [&](std::uint32_t read) { good = good && read != set; });
      });
    return good;
  }

  /// How a test ends by what is known; only of what has been computed there without a fault.
  Outcome outcome_of(const Relation& test) const {
    for (const auto& known : known_) {
      if (!same(code_, known.left, test.left) || !code_.is_number(test.right))
        continue;
      const auto number = [&](std::uint32_t term) {
        return compiler::Range::only(code_.terms[term].value);
      };
      const auto left = where(known.comparison, {}, number(known.right));
      if (left && !where(test.comparison, *left, number(test.right)))
        return Outcome::Never;
      if (left && !where(opposite(test.comparison), *left, number(test.right)))
        return Outcome::Always;
    }
    return Outcome::Unknown;
  }

  Code& code_;
  std::vector<std::uint32_t> at_; ///< of each label: its line
  std::vector<Relation> known_;
};

} // namespace

void fall_through_tests(Code& code) {
  Faller(code).run();
}

} // namespace orb::structured
