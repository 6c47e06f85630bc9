#include "structured/lift/graph.h"

#include <algorithm>
#include <map>
#include <utility>

namespace orb::structured::lifting {
namespace {

// ---- from steps to nodes

class GraphBuilder {
public:
  GraphBuilder(const compiler::Program& program, const ControlFlow& ways, std::uint32_t first)
      : program_(program), ways_(ways), first_(first) {
    graph_.is_main = first == none;
    graph_.nodes.push_back({NodeKind::Exit, none, none, {}, {}});
  }

  Graph build() {
    graph_.entry = node_of(graph_.is_main ? 0 : first_);
    for (std::uint32_t n = 1; n < graph_.nodes.size(); ++n)
      connect(n);
    return std::move(graph_);
  }

private:
  static constexpr std::uint32_t exit = 0;

  std::uint32_t add(NodeKind kind, std::uint32_t step, std::uint32_t sub = none) {
    graph_.nodes.push_back({kind, step, sub, {}, {}});
    return static_cast<std::uint32_t>(graph_.nodes.size()) - 1;
  }

  NodeKind kind_of(std::uint32_t step) const {
    const auto& statement = program_.statements[ways_.steps[step].statement];
    switch (spec::info(statement.kind).form) {
    case spec::Form::Conditional: return NodeKind::Test;
    case spec::Form::Loop: return NodeKind::Begin;
    case spec::Form::LoopEnd: return NodeKind::Close;
    case spec::Form::Branch:
      return statement.kind == spec::Statement::Goto ? NodeKind::Empty : NodeKind::Statement;
    case spec::Form::IndexedBranch:
      return statement.spelling == compiler::Spelling::OnGosub ? NodeKind::Statement
                                                               : NodeKind::Choice;
    case spec::Form::Assignment:
    case spec::Form::Output:
    case spec::Form::Entry:
    case spec::Form::Values:
    case spec::Form::Variables: return NodeKind::Statement;
    case spec::Form::Arguments: return kind_of_word(statement.kind);
    }
    return NodeKind::Statement;
  }

  NodeKind kind_of_word(spec::Statement statement) const {
    if (spec::info(statement).after != spec::After::Ends)
      return NodeKind::Statement;
    const bool leaves = statement == spec::Statement::Return ||
                        (statement == spec::Statement::End && graph_.is_main);
    return leaves ? NodeKind::Empty : NodeKind::Stop;
  }

  /// The final target of a jump, through other jumps without a comment; stays at a jump to itself.
  std::uint32_t thread(std::uint32_t step) const {
    for (std::size_t jumps = 0; jumps < ways_.steps.size() && step != ways_.end(); ++jumps) {
      const auto& jump = ways_.steps[step];
      if (program_.statements[jump.statement].kind != spec::Statement::Goto || jump.remarked)
        break;
      step = jump.targets.front();
    }
    return step;
  }

  std::uint32_t node_of(std::uint32_t step) {
    step = thread(step);
    if (step == ways_.end() || !ways_.steps[step].reached) // after a call that never returns
      return graph_.is_main ? exit : after_last();
    const auto sub = std::lower_bound(ways_.subroutines.begin(), ways_.subroutines.end(), step);
    const bool other = sub != ways_.subroutines.end() && *sub == step && step != first_;
    const auto kind = kind_of(step);
    const bool jumps =
        program_.statements[ways_.steps[step].statement].kind == spec::Statement::Goto;
    if (!other && kind == NodeKind::Empty && !jumps && !ways_.steps[step].remarked)
      return exit;
    auto [known, is_new] = node_of_step_.try_emplace(step, none);
    if (is_new)
      known->second = other ? add(NodeKind::Tail, none,
                                  static_cast<std::uint32_t>(sub - ways_.subroutines.begin()))
                            : add(kind, step);
    return known->second;
  }

  std::uint32_t after_last() {
    if (after_last_ == none)
      after_last_ = add(NodeKind::Stop, none);
    return after_last_;
  }

  std::uint32_t head_of(std::uint32_t loop) {
    auto [known, is_new] = heads_.try_emplace(loop, none);
    if (is_new) {
      const auto head = add(NodeKind::Head, loop);
      known->second = head;
    }
    return known->second;
  }

  void connect(std::uint32_t n) {
    const auto kind = graph_.nodes[n].kind;
    if (kind == NodeKind::Stop)
      return;
    if (kind == NodeKind::Tail) {
      graph_.nodes[n].successors = {exit};
      return;
    }
    const auto s = graph_.nodes[n].step;
    const auto& step = ways_.steps[s];
    std::vector<std::uint32_t> to;
    switch (kind) {
    case NodeKind::Test: to = {node_of(s + 1), node_of(step.otherwise)}; break;
    case NodeKind::Choice:
      for (const auto target : step.targets)
        to.push_back(node_of(target));
      break;
    case NodeKind::Begin: to = {head_of(s)}; break;
    case NodeKind::Close: to = {head_of(step.loop), node_of(step.next)}; break;
    case NodeKind::Empty: to = {jump_of(step)}; break;
    case NodeKind::Head:
    case NodeKind::Statement: to = {node_of(step.next)}; break;
    case NodeKind::Exit:
    case NodeKind::Tail:
    case NodeKind::Stop: break;
    }
    graph_.nodes[n].successors = std::move(to);
  }

  std::uint32_t jump_of(const Step& step) {
    const bool jumps = program_.statements[step.statement].kind == spec::Statement::Goto;
    return jumps ? node_of(step.targets.front()) : exit;
  }

  const compiler::Program& program_;
  const ControlFlow& ways_;
  std::uint32_t first_;
  Graph graph_;
  std::map<std::uint32_t, std::uint32_t> node_of_step_;
  std::map<std::uint32_t, std::uint32_t> heads_; ///< the loop head for a step
  std::uint32_t after_last_ = none;
};

// ---- order, dominators, loops

/// Computes reverse postorder, preferring text order where there is a choice.
std::vector<std::uint32_t> order_nodes(Graph& graph) {
  std::vector<std::uint32_t> order;
  std::vector<std::uint8_t> state(graph.nodes.size(), 0);
  struct OpenNode {
    std::uint32_t node;
    std::vector<std::uint32_t> rest; ///< successors to visit, the last one first
  };
  std::vector<OpenNode> path;
  const auto open = [&](std::uint32_t n) {
    state[n] = 1;
    auto rest = graph.nodes[n].successors;
    const auto place = [&](std::uint32_t s) {
      const auto* node = &graph.nodes[s];
      while (node->kind == NodeKind::Head && node->step == none)
        node = &graph.nodes[node->successors.front()];
      return std::pair(node->step, s);
    };
    std::sort(rest.begin(), rest.end(),
              [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
    path.push_back({n, std::move(rest)});
  };
  open(graph.entry);
  while (!path.empty()) {
    auto& top = path.back();
    if (top.rest.empty()) {
      order.push_back(top.node);
      path.pop_back();
      continue;
    }
    const auto next = top.rest.back();
    top.rest.pop_back();
    if (state[next] == 0)
      open(next);
  }
  std::reverse(order.begin(), order.end());
  for (std::uint32_t i = 0; i < order.size(); ++i)
    graph.nodes[order[i]].rank = i;
  return order;
}

void find_predecessors(Graph& graph) {
  for (std::uint32_t n = 0; n < graph.nodes.size(); ++n)
    for (const auto next : graph.nodes[n].successors) {
      auto& list = graph.nodes[next].predecessors;
      if (list.empty() || list.back() != n)
        list.push_back(n);
    }
}

void find_dominators(Graph& graph, const std::vector<std::uint32_t>& order) {
  auto& nodes = graph.nodes;
  const auto meet = [&](std::uint32_t a, std::uint32_t b) {
    while (a != b) {
      while (nodes[a].rank > nodes[b].rank)
        a = nodes[a].dominator;
      while (nodes[b].rank > nodes[a].rank)
        b = nodes[b].dominator;
    }
    return a;
  };
  nodes[graph.entry].dominator = graph.entry;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto n : order) {
      if (n == graph.entry)
        continue;
      auto dominator = none;
      for (const auto before : nodes[n].predecessors)
        if (nodes[before].dominator != none)
          dominator = dominator == none ? before : meet(dominator, before);
      changed = changed || nodes[n].dominator != dominator;
      nodes[n].dominator = dominator;
    }
  }
}

Loop natural_loop(const Graph& graph, std::uint32_t head, std::vector<std::uint32_t> latches) {
  Loop loop;
  loop.head = head;
  loop.latches = latches;
  loop.members.assign(graph.nodes.size(), false);
  loop.members[head] = true;
  auto work = std::move(latches);
  while (!work.empty()) {
    const auto n = work.back();
    work.pop_back();
    if (loop.members[n])
      continue;
    loop.members[n] = true;
    const auto& before = graph.nodes[n].predecessors;
    work.insert(work.end(), before.begin(), before.end());
  }
  return loop;
}

std::size_t size_of(const Loop& loop) {
  return static_cast<std::size_t>(std::count(loop.members.begin(), loop.members.end(), true));
}

void find_loops(Graph& graph, const std::vector<std::uint32_t>& order) {
  graph.loops.clear();
  for (const auto n : order) {
    std::vector<std::uint32_t> latches;
    for (const auto before : graph.nodes[n].predecessors)
      if (graph.nodes[before].rank != none && graph.dominates(n, before))
        latches.push_back(before);
    if (!latches.empty())
      graph.loops.push_back(natural_loop(graph, n, std::move(latches)));
  }
  std::stable_sort(graph.loops.begin(), graph.loops.end(),
                   [](const Loop& a, const Loop& b) { return size_of(a) > size_of(b); });
  for (std::uint32_t l = 0; l < graph.loops.size(); ++l) {
    graph.loops[l].parent = graph.nodes[graph.loops[l].head].loop;
    for (std::uint32_t n = 0; n < graph.nodes.size(); ++n)
      if (graph.loops[l].members[n])
        graph.nodes[n].loop = l;
  }
}

/// Gives the outer of two loops with the same start a separate head. Returns false if there are no
/// such loops.
bool part_heads(Graph& graph) {
  for (const auto& loop : graph.loops) {
    if (loop.latches.size() < 2 || graph.nodes[loop.head].kind == NodeKind::Head)
      continue;
    std::vector<Loop> single;
    for (const auto latch : loop.latches)
      single.push_back(natural_loop(graph, loop.head, {latch}));
    const auto inner =
        std::min_element(single.begin(), single.end(),
                         [](const auto& a, const auto& b) { return size_of(a) < size_of(b); });
    const bool inside = std::all_of(single.begin(), single.end(), [&](const Loop& other) {
      if (&other == &*inner)
        return true;
      for (std::size_t n = 0; n < other.members.size(); ++n)
        if (inner->members[n] && !other.members[n])
          return false;
      return !inner->members[other.latches.front()];
    });
    if (!inside)
      continue;
    const auto head = loop.head;
    const auto latch = inner->latches.front();
    const auto outer = static_cast<std::uint32_t>(graph.nodes.size());
    for (std::uint32_t n = 0; n < outer; ++n)
      if (n != latch)
        std::replace(graph.nodes[n].successors.begin(), graph.nodes[n].successors.end(), head,
                     outer);
    graph.nodes.push_back({NodeKind::Head, none, none, {head}, {}});
    if (graph.entry == head)
      graph.entry = outer;
    return true;
  }
  return false;
}

} // namespace

bool Graph::dominates(std::uint32_t above, std::uint32_t below) const {
  while (nodes[below].rank > nodes[above].rank)
    below = nodes[below].dominator;
  return above == below;
}

Graph make_graph(const compiler::Program& program, const ControlFlow& ways, std::uint32_t first) {
  auto graph = GraphBuilder(program, ways, first).build();
  do {
    for (auto& node : graph.nodes) {
      node.predecessors.clear();
      node.rank = node.dominator = node.loop = none;
    }
    find_predecessors(graph);
    const auto order = order_nodes(graph);
    find_dominators(graph, order);
    find_loops(graph, order);
  } while (part_heads(graph));
  return graph;
}

} // namespace orb::structured::lifting
