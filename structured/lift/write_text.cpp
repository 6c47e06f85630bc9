#include "structured/lift/write_text.h"

#include "structured/layout/format.h"
#include "structured/lift/choices.h"
#include "structured/lift/effects.h"
#include "structured/lift/statements.h"
#include "structured/lift/tests.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <optional>
#include <utility>

namespace orb::structured::lifting {
namespace {

constexpr std::size_t longest_line = 76; ///< limit for an `if` on one line

/// True if a text contains more than comments.
bool has_statement(std::string_view text) {
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
    if (text[at] != '\'' && text[at] != '\n')
      return true;
  return false;
}

/// Writes the blocks of each routine as text. Large because each kind of block has its own writer,
/// and all of them share names, values, conditions and comments.
class Writer {
public:
  Writer(const compiler::Program& program, const ControlFlow& ways, const Comments& comments,
         const std::vector<Graph>& graphs, const Proofs& proofs)
      : program_(program), ways_(ways), comments_(comments),
        graphs_(graphs), hints_{proofs.counted, prepared_tests(program, ways)},
        names_(program, ways, comments), values_(program, names_),
        tests_(program, ways, names_, values_, hints_.prepared),
        choices_(program, ways, names_, values_, proofs.covered) {}

  LiftedText write() {
    for (std::size_t g = 0; g < graphs_.size(); ++g)
      routine(g);
    auto text = top();
    const auto above = not_blank(text, text.size());
    lines_.insert(lines_.begin(), above, ways_.steps.front().line);
    text += out_;
    for (const auto comment : comments_.last)
      text += fmt::format("{}\n", comment);
    return {format(text), std::move(lines_), std::move(loops_), choices_.stops()};
  }

private:
  // ---- the program and its routines

  void line(std::string_view text) {
    out_ += fmt::format("{}\n", text);
    lines_.push_back(source_line_);
  }
  /// Attributes the following lines to the line of this node.
  void at(std::uint32_t n) {
    if (const auto step = graph_->nodes[n].step; step != none)
      source_line_ = ways_.steps[step].line;
  }

  void routine(std::size_t g) {
    graph_ = &graphs_[g];
    labels_.clear();
    const bool is_main = graph_->is_main;
    const auto first = is_main ? 0 : ways_.subroutines[g - 1];
    routine_line_ = source_line_ = ways_.steps[first].line;
    if (!is_main) {
      out_ += '\n';
      for (const auto comment : comments_.before[routine_line_])
        line(comment);
      line(fmt::format("sub {}", names_.sub(g - 1)));
    }
    list(make_blocks(*graph_, hints_));
    if (!is_main)
      line("end sub");
    else if (!has_statement(out_))
      line("end");
  }

  /// The program's first comments and its declarations.
  std::string top() const {
    std::string text;
    for (const auto comment : comments_.before[ways_.steps.front().line])
      text += fmt::format("{}\n", comment);
    const auto declared = values_.declarations();
    return declared.empty() ? text : fmt::format("{}{}\n", text, declared);
  }

  // ---- comments

  bool begins_line(std::uint32_t n) const {
    const auto step = graph_->nodes[n].step;
    return step != none && ways_.steps[step].begins_line && graph_->nodes[n].kind != NodeKind::Head;
  }
  const std::vector<std::string_view>& comments_above(std::uint32_t n) const {
    static const std::vector<std::string_view> no_comments;
    if (!begins_line(n))
      return no_comments;
    const auto line = ways_.steps[graph_->nodes[n].step].line;
    return line == routine_line_ ? no_comments : comments_.before[line];
  }
  /// The comment at the end of the node's line.
  std::string_view comment_of(std::uint32_t n) const {
    if (!begins_line(n))
      return {};
    return program_.text_of(program_.lines[ways_.steps[graph_->nodes[n].step].line].comment);
  }
  void comments(std::uint32_t n) {
    for (const auto comment : comments_above(n))
      line(comment);
  }
  void with_comment(std::string_view text, std::uint32_t n) {
    line(fmt::format("{} {}", text, comment_of(n)));
  }

  // ---- pieces

  void list(const Pieces& pieces) {
    for (const auto& piece : pieces)
      write(piece);
  }

  void write(const Piece& piece) {
    if (piece.node != none)
      at(piece.node);
    switch (piece.kind) {
    case PieceKind::Write: {
      comments(piece.node);
      const auto lines = lines_of(piece.node);
      const bool is_test = graph_->nodes[piece.node].kind == NodeKind::Test;
      for (std::size_t i = 0; i < lines.size(); ++i)
        i == 0 && !is_test ? with_comment(lines[i], piece.node) : line(lines[i]);
      return;
    }
    case PieceKind::Comments:
      comments(piece.node);
      if (!comment_of(piece.node).empty())
        line(comment_of(piece.node));
      return;
    case PieceKind::Label: line(fmt::format("{}:", label_of(piece.node))); return;
    case PieceKind::Goto:
    case PieceKind::Exit:
    case PieceKind::Continue:
    case PieceKind::Leave: line(jump(piece)); return;
    case PieceKind::If: test(piece); return;
    case PieceKind::Select: select(piece); return;
    case PieceKind::For: count(piece); return;
    case PieceKind::While:
      comments(piece.node);
      with_comment(fmt::format("while {}", condition(piece.node, piece.negated)), piece.node);
      list(piece.first);
      line("end while");
      return;
    case PieceKind::Until:
      line("repeat");
      list(piece.first);
      at(piece.end);
      tested(fmt::format("until {}", condition(piece.end, piece.negated)), piece.end);
      return;
    case PieceKind::Forever:
      line("loop");
      list(piece.first);
      line("end loop");
      return;
    }
  }

  std::string jump(const Piece& piece) {
    if (piece.kind == PieceKind::Goto)
      return fmt::format("goto {}", label_of(piece.node));
    if (piece.kind == PieceKind::Leave)
      return graph_->is_main ? "end" : "return";
    return piece.kind == PieceKind::Exit ? "exit" : "continue";
  }

  std::string label_of(std::uint32_t n) {
    auto& name = labels_[n];
    if (name.empty()) {
      auto at = n;
      while (graph_->nodes[at].step == none && !graph_->nodes[at].successors.empty())
        at = graph_->nodes[at].successors.front();
      const auto step = graph_->nodes[at].step;
      name = step == none ? names_.fresh("line_end") : names_.label(ways_.steps[step].line);
    }
    return name;
  }

  /// A block of one statement that fits after `then`.
  std::optional<std::string> short_text(const Pieces& pieces) {
    if (pieces.size() != 1)
      return std::nullopt;
    const auto& only = pieces.front();
    if (only.kind == PieceKind::Goto || only.kind == PieceKind::Exit ||
        only.kind == PieceKind::Continue || only.kind == PieceKind::Leave)
      return jump(only);
    if (only.kind != PieceKind::Write || !comments_above(only.node).empty() ||
        !comment_of(only.node).empty())
      return std::nullopt;
    const auto stops = choices_.stops().size();
    auto lines = lines_of(only.node);
    choices_.forget_stops_from(stops); // they are written again if the text is not short
    return lines.size() == 1 ? std::optional(std::move(lines.front())) : std::nullopt;
  }

  /// Writes a test. The comment of a `next` is at its own statement, before the test.
  void tested(std::string_view text, std::uint32_t n) {
    graph_->nodes[n].kind == NodeKind::Test ? with_comment(text, n) : line(text);
  }

  void test(const Piece& piece) {
    if (graph_->nodes[piece.node].kind == NodeKind::Test) {
      comments(piece.node);
      for (const auto& prepared : lines_of(piece.node))
        line(prepared);
    }
    const auto text = fmt::format("if {} then", condition(piece.node, piece.negated));
    const auto then = short_text(piece.first);
    const auto otherwise = short_text(piece.second);
    if (then && (otherwise || piece.second.empty())) {
      auto whole = fmt::format("{} {}", text, *then);
      if (otherwise)
        whole += fmt::format(" else {}", *otherwise);
      if (whole.size() <= longest_line)
        return tested(whole, piece.node);
    }
    tested(text, piece.node);
    list(piece.first);
    other_ways(piece.second);
    line("end if");
  }

  void other_ways(const Pieces& pieces) {
    if (pieces.empty())
      return;
    const auto& first = pieces.front();
    const bool chain = pieces.size() == 1 && first.kind == PieceKind::If &&
                       comments_above(first.node).empty() &&
                       graph_->nodes[first.node].kind == NodeKind::Test &&
                       !hints_.prepared[graph_->nodes[first.node].step];
    if (!chain) {
      line("else");
      list(pieces);
      return;
    }
    with_comment(fmt::format("elseif {} then", condition(first.node, first.negated)), first.node);
    list(first.first);
    other_ways(first.second);
  }

  void count(const Piece& piece) {
    const auto step = graph_->nodes[piece.node].step;
    const auto view = program_.as<compiler::ForView>(statement_of(program_, ways_, step));
    comments(piece.node);
    loops_.push_back(step);
    const auto name = values_.letter_set(view.variable.value);
    auto text =
        fmt::format("for {} = {} to {}", name, values_.text(view.start), values_.text(view.end));
    if (view.step != nullptr)
      text += fmt::format(" step {}", values_.text(*view.step));
    with_comment(text, piece.node);
    list(piece.first);
    comments(piece.end);
    with_comment(fmt::format("next {}", name), piece.end);
  }

  // ---- choices

  void select(const Piece& piece) {
    comments(piece.node);
    const auto step = graph_->nodes[piece.node].step;
    for (const auto& text : choices_.begin(step))
      with_comment(text, piece.node);
    for (const auto& way : piece.ways) {
      line(fmt::format("case {}", fmt::join(way.values, ", ")));
      list(way.pieces);
    }
    for (const auto& text : choices_.end(step))
      line(text);
  }

  // ---- statements and conditions

  /// The condition under which a node goes to its first successor.
  std::string condition(std::uint32_t n, bool negated) {
    const auto step = graph_->nodes[n].step;
    if (graph_->nodes[n].kind == NodeKind::Close)
      return tests_.is_over(ways_.steps[step].loop, !negated);
    return tests_.condition(step, negated);
  }

  std::vector<std::string> lines_of(std::uint32_t n) {
    const auto& node = graph_->nodes[n];
    if (node.kind == NodeKind::Tail)
      return {names_.sub(node.sub)};
    if (node.kind == NodeKind::Test)
      return tests_.prepare(node.step);
    if (node.step == none)
      return {"end"};
    if (node.kind == NodeKind::Close)
      return {tests_.count(ways_.steps[node.step].loop)};
    if (node.kind == NodeKind::Begin)
      return tests_.begin_loop(node.step);
    const auto& statement = statement_of(program_, ways_, node.step);
    if (statement.kind == spec::Statement::On)
      return choices_.calls(node.step);
    if (statement.kind == spec::Statement::Gosub)
      return {sub_at(ways_, names_, ways_.steps[node.step].targets.front())};
    return {statement_text(program_, statement, values_)};
  }

  const compiler::Program& program_;
  const ControlFlow& ways_;
  const Comments& comments_;
  const std::vector<Graph>& graphs_;
  Hints hints_;
  LiftedNames names_;
  LiftedValues values_;
  LiftedTests tests_;
  LiftedChoices choices_;
  std::string out_;
  std::vector<std::uint32_t> lines_;
  std::uint32_t source_line_ = 0;
  const Graph* graph_ = nullptr;
  std::uint32_t routine_line_ = none;           ///< the first line of the routine
  std::map<std::uint32_t, std::string> labels_; ///< of nodes
  std::vector<std::uint32_t> loops_;
};

} // namespace

std::size_t not_blank(std::string_view text, std::size_t end) {
  std::size_t lines = 0;
  for (std::size_t i = 0; i < end; ++i)
    lines += text[i] == '\n' && i > 0 && text[i - 1] != '\n' ? 1 : 0;
  return lines;
}

LiftedText write_text(const compiler::Program& program, const ControlFlow& ways,
                      const Comments& comments, const std::vector<Graph>& graphs,
                      const Proofs& proofs) {
  return Writer(program, ways, comments, graphs, proofs).write();
}

} // namespace orb::structured::lifting
