#include "compiler/analyse/trial_need.h"

#include "compiler/analyse/range.h"
#include "spec/limits.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace orb::compiler {
namespace {

constexpr std::int64_t least_number = std::numeric_limits<std::int32_t>::min();
constexpr std::int64_t greatest_number = std::numeric_limits<std::int32_t>::max();

class Need {
public:
  Need(const Program& program, const Flow& flow) : program_(program), flow_(flow) {}

  bool find() {
    if (!flow_.all(spec::Statement::Read).empty() || !collect())
      return true;
    if (suspects_.empty())
      return false;
    prepare();
    follow();
    return std::any_of(suspects_.begin(), suspects_.end(), [&](const Suspect& one) {
      const auto range = compute(one.root);
      return one.divides ? range.has(0) : range.lo < one.least || range.hi > one.greatest;
    });
  }

private:
  /// An expression of letters that must stay within bounds, or not be 0.
  struct Suspect {
    std::uint32_t root;
    std::int64_t least;
    std::int64_t greatest;
    bool divides;
  };

  /// An assignment to a letter.
  struct Set {
    const StatementNode* statement;
    std::uint32_t letter;
  };

  /// Collects suspects. Returns false if an expression uses something that is not tracked here.
  bool collect() {
    for (const auto& node : program_.nodes) {
      const auto index = static_cast<std::uint32_t>(&node - program_.nodes.data());
      if (node.kind == NodeKind::Indexed)
        return false;
      if (node.kind == NodeKind::Call)
        suspect(index - 1, spec::functions[node.what].least, spec::functions[node.what].greatest);
      else if (node.kind == NodeKind::Binary)
        suspect_right(static_cast<spec::Operator>(node.what), index - 1);
    }
    for (const auto& statement : program_.statements)
      if (!statement.error)
        collect(statement);
    return std::none_of(program_.items.begin(), program_.items.end(),
                        [](const Item& item) { return item.kind == ItemKind::Indexed; });
  }

  void collect(const StatementNode& statement) {
    const auto& row = spec::info(statement.kind);
    const auto items = program_.items_of(statement);
    if (row.form == spec::Form::Arguments) {
      for (std::size_t i = 0; i < items.size(); ++i)
        suspect(items[i].value, row.parameter_slots[i].least, row.parameter_slots[i].greatest);
    } else if (row.form == spec::Form::IndexedBranch) {
      const auto on = program_.as<OnView>(statement);
      suspect(on.selector.value, 1, static_cast<std::int64_t>(on.targets.size()));
    } else if (row.form == spec::Form::Assignment) {
      const auto let = program_.as<LetView>(statement);
      if (let.variable.kind == ItemKind::System) {
        const auto& variable = spec::variables[let.variable.value];
        suspect(let.expression.value, variable.least, variable.greatest);
      }
    }
  }

  void suspect(std::uint32_t root, std::int64_t least, std::int64_t greatest) {
    if (has_letters(root) && (least > least_number || greatest < greatest_number))
      suspects_.push_back({root, least, greatest, false});
  }

  void suspect_right(spec::Operator op, std::uint32_t root) {
    const bool divides = op == spec::Operator::Divide || op == spec::Operator::Remainder;
    const bool shifts = op == spec::Operator::ShiftLeft || op == spec::Operator::ShiftRight;
    if (divides && has_letters(root))
      suspects_.push_back({root, 0, 0, true});
    else if (shifts)
      suspect(root, 0, spec::value_of(spec::Limit::GreatestShift));
  }

  bool has_letters(std::uint32_t root) const {
    const auto begin = program_.nodes.begin();
    return std::any_of(begin + program_.nodes[root].first, begin + root + 1,
                       [](const Node& node) { return node.kind == NodeKind::Letter; });
  }

  /// Finds the letters that suspects depend on, and their assignments.
  void prepare() {
    ranges_.assign(std::numeric_limits<std::uint8_t>::max() + std::size_t{1}, Range::only(0));
    counts_.assign(ranges_.size(), 0);
    known_.resize(program_.nodes.size());
    for (const auto& one : suspects_)
      count(program_.nodes[one.root].first, one.root + 1);
    for (bool more = true; more;) {
      more = false;
      for (const auto kind : {spec::Statement::Let, spec::Statement::For})
        for (const auto& place : flow_.all(kind)) {
          const auto& statement = program_.statements[place.statement];
          const auto& variable = program_.items_of(statement).front();
          if (variable.kind == ItemKind::Letter && counts_[variable.value] != 0)
            more = count(statement.nodes_begin, statement.nodes_end) || more;
        }
    }
    for (const auto kind : {spec::Statement::Let, spec::Statement::For, spec::Statement::Input})
      for (const auto& place : flow_.all(kind)) {
        const auto& statement = program_.statements[place.statement];
        const auto& variable = program_.items_of(statement).front();
        if (variable.kind == ItemKind::Letter && counts_[variable.value] != 0)
          sets_.push_back({&statement, variable.value});
      }
  }

  bool count(std::uint32_t begin, std::uint32_t end) {
    bool more = false;
    for (auto n = begin; n < end; ++n)
      if (const auto& node = program_.nodes[n];
          node.kind == NodeKind::Letter && counts_[node.what] == 0) {
        counts_[node.what] = 1;
        more = true;
      }
    return more;
  }

  /// Joins all assigned values until nothing changes.
  void follow() {
    constexpr int patience = 2;
    std::vector<std::int32_t> landmarks;
    for (int round = 0;; ++round) {
      if (round == patience)
        landmarks = landmarks_of(numbers());
      bool more = false;
      for (const auto& one : sets_) {
        auto& range = ranges_[one.letter];
        auto now = join(range, set_by(*one.statement));
        if (now == range)
          continue;
        if (round >= patience)
          now = widen(landmarks, range, now);
        range = now;
        more = true;
      }
      if (!more)
        return;
    }
  }

  std::vector<std::int32_t> numbers() const {
    std::vector<std::int32_t> all;
    for (const auto& one : sets_)
      for (auto n = one.statement->nodes_begin; n < one.statement->nodes_end; ++n)
        if (program_.nodes[n].kind == NodeKind::Number)
          all.push_back(program_.nodes[n].value);
    return all;
  }

  Range set_by(const StatementNode& statement) {
    if (statement.kind == spec::Statement::Input)
      return {};
    if (statement.kind == spec::Statement::Let)
      return compute(program_.as<LetView>(statement).expression.value);
    const auto loop = program_.as<ForView>(statement);
    const auto begin = compute(loop.start.value);
    const auto counted = join(begin, compute(loop.end.value));
    const auto step = loop.step != nullptr ? compute(loop.step->value) : Range::only(1);
    return join(counted, apply(spec::Operator::Add, counted, step)); // the end value plus a step
                                                                     // occurs, too
  }

  const Range& compute(std::uint32_t root) {
    for (auto n = program_.nodes[root].first; n <= root; ++n)
      known_[n] = compute(program_.nodes[n], n);
    return known_[root];
  }

  Range compute(const Node& node, std::uint32_t index) const {
    switch (node.kind) {
    case NodeKind::Number: return node.overflow ? Range{} : Range::only(node.value);
    case NodeKind::Letter: return ranges_[node.what];
    case NodeKind::Indexed: return {};
    case NodeKind::System:
      return {spec::variables[node.what].least, spec::variables[node.what].greatest};
    case NodeKind::Group: return known_[index - 1];
    case NodeKind::Negate: return negate(known_[index - 1]);
    case NodeKind::Call: return apply(spec::functions[node.what].function, known_[index - 1]);
    case NodeKind::Binary:
      return apply(static_cast<spec::Operator>(node.what),
                   known_[program_.nodes[index - 1].first - 1], known_[index - 1]);
    }
    return {};
  }

  const Program& program_;
  const Flow& flow_;
  std::vector<Suspect> suspects_;
  std::vector<Set> sets_;
  std::vector<Range> ranges_;        ///< by letter
  std::vector<std::uint8_t> counts_; ///< by letter: true if a suspect depends on it
  std::vector<Range> known_;         ///< by node
};

} // namespace

bool needs_trial(const Program& program, const Flow& flow) {
  return Need(program, flow).find();
}

} // namespace orb::compiler
