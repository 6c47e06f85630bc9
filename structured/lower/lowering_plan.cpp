#include "structured/lower/lowering_plan.h"

#include "spec/limits.h"
#include "structured/meaning/check.h"
#include "structured/text/link_blocks.h"

#include <algorithm>
#include <set>

namespace orb::structured {
namespace {

// Estimated sizes in bytes of the robot's lines. They only choose between two correct programs.
constexpr std::uint32_t call_bytes = 10;   // `12 gosub 34`
constexpr std::uint32_t line_bytes = 6;    // number, space, line ending, a short statement
constexpr std::uint32_t most_bytes = 4096; // no area is larger

class Planner {
public:
  Planner(const Program& program, const Names& names)
      : program_(program), names_(names), calls_(calls_of(program, names)) {
    const auto count = names.routines.size();
    plan_.inlined.assign(count, false);
    plan_.needed.assign(count, false);
    plan_.native.assign(program.statements.size(), false);
    cost_.assign(count, 0);
    sites_.assign(count, 0);
    nested_.assign(count, 0);
    inside_.assign(count, {});
  }

  Plan run() {
    order_routines();
    count_sites();
    for (const auto routine : callees_first_)
      decide(routine);
    keep_depth();
    read_loops();
    return std::move(plan_);
  }

private:
  /// Orders callees before callers, only routines that the main program reaches.
  void order_routines() {
    std::vector<std::pair<std::uint32_t, std::size_t>> path{{0, 0}};
    plan_.needed[0] = true;
    while (!path.empty()) {
      auto& [routine, next] = path.back();
      if (next == calls_[routine].size()) {
        callees_first_.push_back(routine);
        path.pop_back();
        continue;
      }
      const auto callee = calls_[routine][next++];
      if (!plan_.needed[callee]) {
        plan_.needed[callee] = true;
        path.push_back({callee, 0});
      }
    }
  }

  void count_sites() {
    own_cost_.assign(names_.routines.size(), 0);
    for (const auto i : program_.order) {
      const auto routine = names_.routine_of[i];
      if (!plan_.needed[routine])
        continue;
      const auto& statement = program_.statements[i];
      each_call(program_, names_, i, [&](std::uint32_t callee, Span) { ++sites_[callee]; });
      own_cost_[routine] += cost_of(statement);
    }
  }

  std::uint32_t cost_of(const Statement& statement) const {
    const auto kind = statement.kind;
    if (kind == Kind::Sub || kind == Kind::Function || kind == Kind::EndSub ||
        kind == Kind::EndFunction || kind == Kind::Local || kind == Kind::Const ||
        kind == Kind::Array)
      return 0;
    std::uint32_t cost = line_bytes;
    for (const auto& item : program_.items_of(statement)) {
      if (item.kind == ItemKind::String)
        cost += item.span.size();
      else if (item.kind == ItemKind::Expression || item.kind == ItemKind::Place)
        cost += (item.value - program_.nodes[item.value].first + 1) * 3 / 2;
      else
        ++cost;
    }
    return cost;
  }

  /// Decides on a routine after its callees.
  void decide(std::uint32_t routine) {
    std::uint64_t cost = own_cost_[routine];
    for (const auto callee : calls_[routine])
      cost += plan_.inlined[callee] ? cost_[callee] : call_bytes;
    cost_[routine] = static_cast<std::uint32_t>(std::min<std::uint64_t>(cost, 1U << 20));
    if (routine == 0)
      return;
    nested_[routine] = nesting(routine);
    // Inline short routines later, once their sizes are known.
    plan_.inlined[routine] = sites_[routine] == 1 && nested_[routine] < deepest_inline;
  }

  /// The depth of nested inlining below this routine.
  std::size_t nesting(std::uint32_t routine) const {
    std::size_t deepest = 0;
    for (const auto callee : calls_[routine])
      if (plan_.inlined[callee])
        deepest = std::max(deepest, nested_[callee] + 1);
    return deepest;
  }

  /// Inlines a routine into its callers, unless the nesting gets too deep.
  bool write_into_callers(std::uint32_t routine) {
    const auto before = nested_;
    plan_.inlined[routine] = true;
    for (const auto one : callees_first_)
      nested_[one] = nesting(one);
    if (std::all_of(nested_.begin(), nested_.end(),
                    [](auto deep) { return deep <= deepest_inline; }))
      return true;
    plan_.inlined[routine] = false;
    nested_ = before;
    return false;
  }

  // ---- the depth of calls

  /// The depth of open calls below each routine, and the callee that causes it.
  std::uint32_t depth_below(std::vector<std::uint32_t>& through) const {
    std::vector<std::uint32_t> depth(names_.routines.size(), 0);
    through.assign(names_.routines.size(), none);
    for (const auto routine : callees_first_)
      for (const auto callee : calls_[routine]) {
        const auto below = depth[callee] + (plan_.inlined[callee] ? 0 : 1);
        if (through[routine] == none || below > depth[routine]) {
          depth[routine] = below;
          through[routine] = callee;
        }
      }
    return depth[0];
  }

  void keep_depth() {
    constexpr int most_rounds = 64;
    const auto most = static_cast<std::uint32_t>(spec::value_of(spec::Limit::GosubDepth));
    std::vector<std::uint32_t> through;
    std::vector<bool> stays(names_.routines.size(), false); // too deep: stays a call
    for (int round = 0; depth_below(through) > most; ++round) {
      std::uint32_t cheapest = none;
      std::uint64_t least = most_bytes;
      for (auto routine = through[0]; routine != none; routine = through[routine]) {
        const auto copies = std::uint64_t{sites_[routine]} * cost_[routine];
        if (!plan_.inlined[routine] && !stays[routine] && copies < least) {
          least = copies;
          cheapest = routine;
        }
      }
      if (cheapest == none || round == most_rounds) {
        for (auto routine = through[0]; routine != none; routine = through[routine])
          plan_.chain.push_back(routine);
        return;
      }
      if (!write_into_callers(cheapest)) {
        stays[cheapest] = true;
        --round; // repeat: nothing has changed
        continue;
      }
      for (const auto routine : callees_first_) {
        std::uint64_t cost = own_cost_[routine];
        for (const auto callee : calls_[routine])
          cost += plan_.inlined[callee] ? cost_[callee] : call_bytes;
        cost_[routine] = static_cast<std::uint32_t>(std::min<std::uint64_t>(cost, 1U << 20));
      }
    }
  }

  // ---- loops

  /// The robot loops inside a construct.
  struct Inside {
    std::uint32_t height = 0;        ///< their nesting depth
    std::set<std::uint32_t> counted; ///< symbols of their counters

    void add(const Inside& other) {
      height = std::max(height, other.height);
      counted.insert(other.counted.begin(), other.counted.end());
    }
  };
  struct OpenLoop {
    std::uint32_t statement;
    bool left = false; ///< a jump leaves it
    Inside inside;
  };

  void read_loops() {
    std::vector<std::vector<std::uint32_t>> bodies(names_.routines.size());
    for (const auto i : program_.order)
      bodies[names_.routine_of[i]].push_back(i);
    for (const auto routine : callees_first_)
      inside_[routine] = read_loops(bodies[routine]);
  }

  Inside read_loops(const std::vector<std::uint32_t>& body) {
    std::vector<OpenLoop> open{{none, false, {}}};
    for (const auto i : body) {
      const auto& statement = program_.statements[i];
      each_call(program_, names_, i,
                [&](std::uint32_t callee, Span) { open.back().inside.add(inside_[callee]); });
      if (is_loop(statement.kind)) {
        open.push_back({i, false, {}});
      } else if (statement.opener != none && statement.opener == open.back().statement) {
        const auto loop = std::move(open.back());
        open.pop_back();
        open.back().inside.add(close(loop));
      } else if (statement.kind == Kind::Exit) {
        open.back().left = true;
      } else if (statement.kind == Kind::Return) {
        for (auto& loop : open)
          loop.left = true;
      } else if (statement.kind == Kind::Goto) {
        const auto label = label_of(statement, body);
        for (auto& loop : open)
          if (loop.statement != none &&
              (label < loop.statement || label > program_.statements[loop.statement].next))
            loop.left = true;
      }
    }
    return std::move(open.front().inside);
  }

  /// Makes a loop a robot loop, if its `next` would find it: a `for` with the variable of an open
  /// loop replaces that loop.
  Inside close(const OpenLoop& loop) {
    const auto& statement = program_.statements[loop.statement];
    const bool counts = statement.kind == Kind::For || statement.kind == Kind::RepeatTimes;
    const auto most = static_cast<std::uint32_t>(spec::value_of(spec::Limit::ForDepth));
    const auto variable =
        statement.kind == Kind::For
            ? names_.of_node[program_.items[statement.items_begin].value] // its place
            : none;
    auto inside = loop.inside;
    const bool again = variable != none && inside.counted.count(variable) != 0;
    if (!counts || loop.left || inside.height >= most || again)
      return inside;
    plan_.native[loop.statement] = true;
    inside.add({inside.height + 1, {variable}});
    return inside;
  }

  std::uint32_t label_of(const Statement& jump, const std::vector<std::uint32_t>& body) const {
    for (const auto i : body)
      if (program_.statements[i].kind == Kind::Label && program_.statements[i].name == jump.name)
        return i;
    return none;
  }

  const Program& program_;
  const Names& names_;
  std::vector<std::vector<std::uint32_t>> calls_;
  Plan plan_;
  std::vector<std::uint32_t> callees_first_;
  std::vector<std::uint32_t> own_cost_;
  std::vector<std::uint32_t> cost_;
  std::vector<std::uint32_t> sites_;
  std::vector<std::size_t> nested_;
  std::vector<Inside> inside_; ///< of each routine
};

} // namespace

Plan plan(const Program& program, const Names& names) {
  return Planner(program, names).run();
}

} // namespace orb::structured
