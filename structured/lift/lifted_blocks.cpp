#include "structured/lift/lifted_blocks.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace orb::structured::lifting {
namespace {

constexpr std::uint32_t exit_node = 0;

/// The form of a loop.
struct Form {
  PieceKind kind = PieceKind::Forever;
  std::uint32_t close = none;  ///< For, Until: the node with the test at the end of the body
  std::uint32_t follow = none; ///< the node after the loop
};

/// Turns the graph of a routine into blocks. Large because each form of loop and each kind of node
/// has its own member.
class BlockWriter {
public:
  BlockWriter(const Graph& graph, const Hints& hints)
      : graph_(graph), hints_(hints), inside_(graph.nodes.size()), outside_(graph.nodes.size()),
        placed_(graph.nodes.size(), false) {}

  Pieces write() {
    for (std::uint32_t l = 0; l < graph_.loops.size(); ++l)
      forms_.push_back(form_of(l));
    place_nodes();
    Pieces out;
    write_tree(graph_.entry, exit_node, out);
    return out;
  }

private:
  struct Context {
    std::uint32_t exit = none;
    std::uint32_t again = none;
  };

  const Node& at(std::uint32_t n) const { return graph_.nodes[n]; }

  // ---- the forms of loops

  bool leaves(std::uint32_t l, std::uint32_t n) const { return !graph_.loops[l].members[n]; }

  /// The successor of a two-way node that leaves a loop, if exactly one does; else none.
  std::uint32_t way_out(std::uint32_t l, std::uint32_t n) const {
    const auto& node = at(n);
    if ((node.kind != NodeKind::Test && node.kind != NodeKind::Close) ||
        leaves(l, node.successors[0]) == leaves(l, node.successors[1]))
      return none;
    return node.successors[leaves(l, node.successors[0]) ? 0 : 1];
  }

  bool is_prepared(std::uint32_t n) const {
    return at(n).kind == NodeKind::Close || hints_.prepared[at(n).step];
  }

  Form form_of(std::uint32_t l) const {
    const auto& loop = graph_.loops[l];
    const auto& head = at(loop.head);
    const auto latch = loop.latches.front();
    const bool single = loop.latches.size() == 1;
    if (single && head.kind == NodeKind::Head && head.step != none &&
        at(latch).kind == NodeKind::Close && hints_.counted[head.step] &&
        head.predecessors.size() == 2)
      return {PieceKind::For, latch, at(latch).successors[1]};
    const auto from_head = way_out(l, loop.head);
    if (from_head != none && !is_prepared(loop.head))
      return {PieceKind::While, none, from_head};
    const auto from_latch = single && latch != loop.head ? way_out(l, latch) : none;
    if (from_latch != none)
      return {PieceKind::Until, latch, from_latch};
    return {PieceKind::Forever, none, usual_exit(l)};
  }

  /// The node where most exits of an endless loop meet; for single ones, the last in the text.
  std::uint32_t usual_exit(std::uint32_t l) const {
    auto best = none;
    for (std::uint32_t n = 0; n < graph_.nodes.size(); ++n) {
      if (leaves(l, n))
        continue;
      for (const auto to : at(n).successors)
        if (leaves(l, to) && (best == none || prefers(to, best)))
          best = to;
    }
    return best;
  }

  bool prefers(std::uint32_t a, std::uint32_t b) const {
    if (is_met(a) != is_met(b))
      return is_met(a);
    return is_met(a) ? at(a).rank < at(b).rank : at(a).rank > at(b).rank;
  }

  // ---- placing nodes

  /// True if several edges lead to a node, not counting back edges to the head of a loop.
  bool is_met(std::uint32_t n) const {
    std::size_t ways = 0;
    for (const auto before : at(n).predecessors)
      ways += graph_.dominates(n, before) ? 0 : 1;
    return ways > 1;
  }

  /// The outermost loop that contains `inner` but not `n`, or none.
  std::uint32_t loop_left(std::uint32_t inner, std::uint32_t n) const {
    auto left = none;
    for (auto l = at(inner).loop; l != none && leaves(l, n); l = graph_.loops[l].parent)
      left = l;
    return left;
  }

  void place_nodes() {
    for (const auto& form : forms_)
      if (form.close != none)
        placed_[form.close] = true; // written as the end of its loop
    for (std::uint32_t n = 1; n < graph_.nodes.size(); ++n) {
      if (n == graph_.entry || at(n).rank == none || placed_[n])
        continue;
      const auto above = at(n).dominator;
      const auto left = loop_left(above, n);
      if (left != none && (is_met(n) || forms_[left].follow == n))
        put(outside_[graph_.loops[left].head], n);
      else if (left == none && is_met(n))
        put(inside_[above], n);
    }
    for (auto* lists : {&inside_, &outside_})
      for (auto& list : *lists)
        std::sort(list.begin(), list.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return at(a).rank < at(b).rank; });
    for (std::uint32_t l = 0; l < forms_.size(); ++l) {
      auto& list = outside_[graph_.loops[l].head];
      const auto follow = std::find(list.begin(), list.end(), forms_[l].follow);
      if (follow != list.end())
        std::rotate(list.begin(), follow, follow + 1);
    }
  }

  void put(std::vector<std::uint32_t>& list, std::uint32_t n) {
    list.push_back(n);
    placed_[n] = true;
  }

  // ---- writing

  bool is_head(std::uint32_t n) const {
    return at(n).loop != none && graph_.loops[at(n).loop].head == n;
  }

  static Piece piece(PieceKind kind, std::uint32_t node) {
    Piece made;
    made.kind = kind;
    made.node = node;
    return made;
  }

  static std::uint32_t first_of(const std::vector<std::uint32_t>& list, std::uint32_t otherwise) {
    return list.empty() ? otherwise : list.front();
  }

  /// Writes a node with all nodes placed under it; `follow` comes next.
  void write_tree(std::uint32_t n, std::uint32_t follow, Pieces& out) {
    if (is_head(n)) {
      write_loop(n, follow, out);
      return;
    }
    write_node(n, first_of(inside_[n], follow), out);
    write_list(inside_[n], follow, out);
  }

  void write_list(const std::vector<std::uint32_t>& list, std::uint32_t follow, Pieces& out) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (!is_head(list[i]))
        out.push_back(piece(PieceKind::Label, list[i]));
      write_tree(list[i], i + 1 < list.size() ? list[i + 1] : follow, out);
    }
  }

  void write_loop(std::uint32_t head, std::uint32_t follow, Pieces& out) {
    const auto& form = forms_[at(head).loop];
    const auto after = first_of(outside_[head], follow);
    out.push_back(piece(PieceKind::Label, head));
    auto loop = piece(form.kind, head);
    const auto last = form.close != none ? form.close : head;
    const bool skips =
        form.close != none && (form.kind != PieceKind::For && is_prepared(form.close));
    open_.push_back({form.kind == PieceKind::Forever ? after : form.follow, skips ? none : last});
    write_body(head, last, form, loop);
    open_.pop_back();
    out.push_back(std::move(loop));
    if (form.kind != PieceKind::Forever)
      write_branch(form.close != none ? form.close : head, form.follow, after, out);
    write_list(outside_[head], follow, out);
  }

  void write_body(std::uint32_t head, std::uint32_t last, const Form& form, Piece& loop) {
    const auto next = first_of(inside_[head], last);
    if (form.kind == PieceKind::While) {
      const auto& ways = at(head).successors;
      loop.negated = ways[0] == form.follow;
      write_branch(head, ways[loop.negated ? 1 : 0], next, loop.first);
    } else {
      write_node(head, next, loop.first);
    }
    write_list(inside_[head], last, loop.first);
    if (form.close == none)
      return;
    loop.end = form.close;
    loop.first.push_back(piece(PieceKind::Label, form.close));
    if (form.kind == PieceKind::For) {
      loop.node = begin_of(head);
    } else {
      loop.negated = at(form.close).successors[1] == form.follow;
      loop.first.push_back(piece(PieceKind::Write, form.close));
    }
  }

  std::uint32_t begin_of(std::uint32_t head) const {
    for (const auto before : at(head).predecessors)
      if (at(before).kind == NodeKind::Begin)
        return before;
    return none;
  }

  bool is_native(std::uint32_t begin) const {
    const auto head = at(begin).successors.front();
    return is_head(head) && forms_[at(head).loop].kind == PieceKind::For;
  }

  void write_node(std::uint32_t n, std::uint32_t follow, Pieces& out) {
    const auto& node = at(n);
    switch (node.kind) {
    case NodeKind::Exit: return;
    case NodeKind::Stop: out.push_back(piece(PieceKind::Write, n)); return;
    case NodeKind::Choice: write_choice(n, follow, out); return;
    case NodeKind::Test: write_test(n, follow, out); return;
    case NodeKind::Close:
      out.push_back(piece(PieceKind::Write, n));
      write_test(n, follow, out);
      return;
    case NodeKind::Empty: out.push_back(piece(PieceKind::Comments, n)); break;
    case NodeKind::Begin:
      if (!is_native(n))
        out.push_back(piece(PieceKind::Write, n));
      break;
    case NodeKind::Statement:
    case NodeKind::Tail: out.push_back(piece(PieceKind::Write, n)); break;
    case NodeKind::Head: break;
    }
    write_branch(n, node.successors.front(), follow, out);
  }

  void write_test(std::uint32_t n, std::uint32_t follow, Pieces& out) {
    auto test = piece(PieceKind::If, n);
    const auto& ways = at(n).successors;
    if (ways[0] != ways[1]) {
      write_branch(n, ways[0], follow, test.first);
      write_branch(n, ways[1], follow, test.second);
      out.push_back(std::move(test));
    } else {
      out.push_back(std::move(test));
      write_branch(n, ways[0], follow, out);
    }
  }

  void write_choice(std::uint32_t n, std::uint32_t follow, Pieces& out) {
    auto choice = piece(PieceKind::Select, n);
    std::vector<std::uint32_t> targets;
    const auto& ways = at(n).successors;
    for (std::uint32_t i = 0; i < ways.size(); ++i) {
      const auto known = std::find(targets.begin(), targets.end(), ways[i]);
      if (known == targets.end()) {
        targets.push_back(ways[i]);
        choice.ways.push_back({{i + 1}, {}});
        write_branch(n, ways[i], follow, choice.ways.back().pieces);
      } else {
        choice.ways[static_cast<std::size_t>(known - targets.begin())].values.push_back(i + 1);
      }
    }
    out.push_back(std::move(choice));
  }

  /// Writes the edge from one node to another, where `follow` comes next.
  void write_branch(std::uint32_t from, std::uint32_t to, std::uint32_t follow, Pieces& out) {
    if (to == follow)
      return;
    if (to != exit_node && to != graph_.entry && !placed_[to] && at(to).dominator == from)
      write_tree(to, follow, out);
    else if (!open_.empty() && to == open_.back().exit)
      out.push_back(piece(PieceKind::Exit, none));
    else if (!open_.empty() && to == open_.back().again)
      out.push_back(piece(PieceKind::Continue, none));
    else
      out.push_back(piece(to == exit_node ? PieceKind::Leave : PieceKind::Goto, to));
  }

  const Graph& graph_;
  const Hints& hints_;
  std::vector<Form> forms_;                         ///< of each loop
  std::vector<std::vector<std::uint32_t>> inside_;  ///< of each node: the nodes written after it
  std::vector<std::vector<std::uint32_t>> outside_; ///< of each head: the nodes after its loop
  std::vector<bool> placed_; ///< written in a sequence instead of at the edge
  std::vector<Context> open_;
};

// ---- simplification

void collect_targets(const Pieces& pieces, std::set<std::uint32_t>& targets) {
  for (const auto& piece : pieces) {
    if (piece.kind == PieceKind::Goto)
      targets.insert(piece.node);
    collect_targets(piece.first, targets);
    collect_targets(piece.second, targets);
    for (const auto& way : piece.ways)
      collect_targets(way.pieces, targets);
  }
}

bool is_jump(const Piece& piece) {
  return piece.kind == PieceKind::Goto || piece.kind == PieceKind::Exit ||
         piece.kind == PieceKind::Continue || piece.kind == PieceKind::Leave;
}

class Simplifier {
public:
  Simplifier(const Graph& graph, const std::set<std::uint32_t>& targets)
      : graph_(graph), targets_(targets) {}

  void simplify(Pieces& pieces) const {
    Pieces out;
    for (auto& piece : pieces) {
      if (piece.kind == PieceKind::Label && !targets_.contains(piece.node))
        continue;
      simplify(piece.first);
      simplify(piece.second);
      for (auto& way : piece.ways)
        simplify(way.pieces);
      if (piece.kind == PieceKind::Forever)
        end_by_test(piece);
      out.push_back(std::move(piece));
      if (out.back().kind == PieceKind::If)
        flatten(out);
    }
    pieces = std::move(out);
  }

private:
  bool leaves(const Pieces& pieces) const {
    return !pieces.empty() &&
           (is_jump(pieces.back()) || (pieces.back().kind == PieceKind::Write &&
                                       graph_.nodes[pieces.back().node].kind == NodeKind::Stop));
  }

  /// Moves the `else` part after the block if the first part never falls through.
  void flatten(Pieces& out) const {
    auto& test = out.back();
    const auto swap = [&] {
      std::swap(test.first, test.second);
      test.negated = !test.negated;
    };
    const bool short_else = test.second.size() == 1 && is_jump(test.second.front());
    if ((test.first.empty() && !test.second.empty()) || (short_else && !leaves(test.first)))
      swap();
    if (!leaves(test.first))
      return;
    auto after = std::move(test.second);
    test.second.clear();
    std::move(after.begin(), after.end(), std::back_inserter(out));
  }

  static bool continues(const Pieces& pieces) {
    return std::any_of(pieces.begin(), pieces.end(), [](const Piece& piece) {
      if (piece.kind == PieceKind::Continue)
        return true;
      if (piece.kind == PieceKind::If)
        return continues(piece.first) || continues(piece.second);
      return std::any_of(piece.ways.begin(), piece.ways.end(),
                         [](const SelectCase& way) { return continues(way.pieces); });
    });
  }

  /// Turns a `loop` whose last statement exits into `repeat … until`.
  void end_by_test(Piece& loop) const {
    if (loop.first.empty() || continues(loop.first))
      return;
    const auto& last = loop.first.back();
    if (last.kind != PieceKind::If || !last.second.empty() || last.first.size() != 1 ||
        last.first.front().kind != PieceKind::Exit)
      return;
    loop.kind = PieceKind::Until;
    loop.end = last.node;
    loop.negated = last.negated;
    if (graph_.nodes[last.node].kind == NodeKind::Close) {
      loop.first.pop_back(); // its statement already precedes the loop end
      return;
    }
    loop.first.back().kind = PieceKind::Write;
    loop.first.back().first.clear();
  }

  const Graph& graph_;
  const std::set<std::uint32_t>& targets_;
};

} // namespace

Pieces make_blocks(const Graph& graph, const Hints& hints) {
  auto pieces = BlockWriter(graph, hints).write();
  std::set<std::uint32_t> targets;
  collect_targets(pieces, targets);
  Simplifier(graph, targets).simplify(pieces);
  return pieces;
}

} // namespace orb::structured::lifting
