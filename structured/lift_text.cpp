#include "structured/lift_text.h"

#include "spec/limits.h"
#include "structured/format.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <optional>
#include <utility>

namespace orb::structured::lifting {
namespace {

using compiler::ItemKind;
using compiler::StatementNode;
using spec::Operator;
using spec::Statement;

constexpr std::size_t longest_line = 76; ///< of an `if` that stays on one line

// ---- what computing a value does besides

bool is_number(const compiler::Program& program, std::uint32_t node, std::int32_t least) {
  const auto& leaf = program.nodes[node];
  return leaf.kind == compiler::NodeKind::Number && leaf.value >= least;
}

/// Whether a node itself, its operands apart, can stop the program or changes what it reads.
bool node_acts(const compiler::Program& program, std::uint32_t n) {
  const auto& node = program.nodes[n];
  switch (node.kind) {
  case compiler::NodeKind::Indexed: return true;
  case compiler::NodeKind::System:
    return spec::variables[node.what].access == spec::Access::ReadClears;
  case compiler::NodeKind::Call:
    return static_cast<spec::Function>(node.what) != spec::Function::Abs;
  case compiler::NodeKind::Binary: {
    const auto op = static_cast<Operator>(node.what);
    const bool shifts = op == Operator::ShiftLeft || op == Operator::ShiftRight;
    if (op == Operator::Divide || op == Operator::Remainder)
      return !is_number(program, n - 1, 1);
    return shifts && !(is_number(program, n - 1, 0) &&
                       program.nodes[n - 1].value <= spec::value_of(spec::Limit::GreatestShift));
  }
  case compiler::NodeKind::Number:
  case compiler::NodeKind::Letter:
  case compiler::NodeKind::Group:
  case compiler::NodeKind::Negate: return false;
  }
  return false;
}

bool acts(const compiler::Program& program, const compiler::Item& item) {
  for (auto n = program.nodes[item.value].first; n <= item.value; ++n)
    if (node_acts(program, n))
      return true;
  return false;
}

bool is_prepared(const compiler::Program& program, const StatementNode& test) {
  const auto view = program.as<compiler::IfView>(test);
  return view.second && (acts(program, view.second->left) || acts(program, view.second->right));
}

/// A time as people say it.
std::string duration(std::int32_t ms) {
  if (ms >= 1000 && ms % 100 == 0)
    return ms % 1000 == 0 ? fmt::format("{}s", ms / 1000)
                          : fmt::format("{}.{}s", ms / 1000, ms % 1000 / 100);
  return fmt::format("{}ms", ms);
}

/// Whether a line of a text is more than a comment.
bool has_statement(std::string_view text) {
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
    if (text[at] != '\'' && text[at] != '\n')
      return true;
  return false;
}

std::string_view sign_of(spec::Relation relation, bool negated) {
  switch (relation) {
  case spec::Relation::Equal: return negated ? "<>" : "=";
  case spec::Relation::NotEqual: return negated ? "=" : "<>";
  case spec::Relation::Less: return negated ? ">=" : "<";
  case spec::Relation::Greater: return negated ? "<=" : ">";
  }
  return "=";
}

class Writer {
public:
  Writer(const compiler::Program& program, const Ways& ways, const Comments& comments,
         const std::vector<Graph>& graphs, const Proofs& proofs)
      : program_(program), ways_(ways), comments_(comments), graphs_(graphs), proofs_(proofs),
        names_(program, ways, comments), hints_{proofs.counted, prepared_tests(program, ways)} {}

  LiftedText write() {
    for (std::size_t g = 0; g < graphs_.size(); ++g)
      routine(g);
    auto text = top();
    const auto above = not_blank(text, text.size());
    lines_.insert(lines_.begin(), above, ways_.steps.front().line);
    text += out_;
    for (const auto comment : comments_.last)
      text += fmt::format("{}\n", comment);
    return {format(text), std::move(lines_), std::move(loops_), std::move(choices_)};
  }

private:
  // ---- the program and its routines

  void line(std::string_view text) {
    out_ += fmt::format("{}\n", text);
    lines_.push_back(source_line_);
  }
  /// What is written from here on is for the line of that node.
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

  /// The program's first comments, and what must be declared.
  std::string top() const {
    std::string text;
    for (const auto comment : comments_.before[ways_.steps.front().line])
      text += fmt::format("{}\n", comment);
    std::string declared;
    if (uses_elements_)
      declared += fmt::format("array {}[{}]\n", names_.elements(),
                              spec::value_of(spec::Limit::IndexedVariables));
    for (std::size_t letter = 0; letter < read_.size(); ++letter)
      if (read_[letter] && !set_[letter])
        declared += fmt::format("{} = 0\n", names_.letter(letter));
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
    const auto choices = choices_.size();
    auto lines = lines_of(only.node);
    choices_.resize(choices); // they are written again where the text is not short
    return lines.size() == 1 ? std::optional(std::move(lines.front())) : std::nullopt;
  }

  /// The comment of a `next` stands at its own statement, before the test.
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
    const auto view = program_.as<compiler::ForView>(statement_of(step));
    comments(piece.node);
    loops_.push_back(step);
    const auto name = letter_set(view.variable.value);
    auto text = fmt::format("for {} = {} to {}", name, value(view.start), value(view.end));
    if (view.step != nullptr)
      text += fmt::format(" step {}", value(*view.step));
    with_comment(text, piece.node);
    list(piece.first);
    comments(piece.end);
    with_comment(fmt::format("next {}", name), piece.end);
  }

  // ---- choices

  void select(const Piece& piece) {
    comments(piece.node);
    const auto step = graph_->nodes[piece.node].step;
    const auto chosen =
        begin_select(step, [&](std::string_view text) { with_comment(text, piece.node); });
    for (const auto& way : piece.ways) {
      line(fmt::format("case {}", fmt::join(way.values, ", ")));
      list(way.pieces);
    }
    for (const auto& text : end_select(step, chosen))
      line(text);
  }

  template <typename Emit>
  std::string begin_select(std::uint32_t step, Emit emit) {
    const auto& selector = program_.as<compiler::OnView>(statement_of(step)).selector;
    auto chosen = value(selector);
    const bool leaf = program_.nodes[selector.value].kind == compiler::NodeKind::Letter;
    if (!proofs_.covered[step] && !leaf) {
      auto& name = helpers_[{step, 0}];
      if (name.empty())
        name = names_.fresh("choice");
      emit(fmt::format("{} = {}", name, chosen));
      chosen = name;
    }
    emit(fmt::format("select {}", chosen));
    return chosen;
  }

  std::vector<std::string> end_select(std::uint32_t step, std::string_view chosen) {
    if (proofs_.covered[step])
      return {"end select"};
    choices_.push_back(step);
    uses_elements_ = true;
    return {"else",
            fmt::format("{}{})] = 0 ' the robot stops here: {}", stopper, chosen,
                        spec::info(spec::BasicError::IllegalIndex).text),
            "end select"};
  }

  std::vector<std::string> calls(std::uint32_t step) {
    std::vector<std::string> lines;
    const auto chosen =
        begin_select(step, [&](std::string text) { lines.push_back(std::move(text)); });
    const auto& targets = ways_.steps[step].targets;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      if (std::find(targets.begin(), targets.begin() + static_cast<std::ptrdiff_t>(i),
                    targets[i]) != targets.begin() + static_cast<std::ptrdiff_t>(i))
        continue;
      std::vector<std::size_t> values;
      for (std::size_t n = i; n < targets.size(); ++n)
        if (targets[n] == targets[i])
          values.push_back(n + 1);
      lines.push_back(fmt::format("case {}", fmt::join(values, ", ")));
      lines.push_back(sub_at(targets[i]));
    }
    for (auto& text : end_select(step, chosen))
      lines.push_back(std::move(text));
    return lines;
  }

  std::string sub_at(std::uint32_t step) const {
    const auto& subs = ways_.subroutines;
    return names_.sub(
        static_cast<std::size_t>(std::lower_bound(subs.begin(), subs.end(), step) - subs.begin()));
  }

  // ---- conditions

  /// The condition under which a node goes to its first successor.
  std::string condition(std::uint32_t n, bool negated) {
    const auto step = graph_->nodes[n].step;
    if (graph_->nodes[n].kind == NodeKind::Close) {
      const auto begin = ways_.steps[step].loop;
      const auto view = program_.as<compiler::ForView>(statement_of(begin));
      const auto relation = step_of(view) > 0 ? spec::Relation::Greater : spec::Relation::Less;
      return fmt::format("{} {} {}", letter_read(view.variable.value), sign_of(relation, !negated),
                         end_of(begin, view));
    }
    const auto view = program_.as<compiler::IfView>(statement_of(step));
    const bool prepared = hints_.prepared[step];
    const auto relation = [&](const compiler::Comparison& comparison, std::uint32_t first) {
      const auto side = [&](const compiler::Item& item, std::uint32_t n_th) {
        return prepared && acts(program_, item) ? helpers_[{step, first + n_th}] : value(item);
      };
      return fmt::format("{} {} {}", side(comparison.left, 0),
                         sign_of(static_cast<spec::Relation>(comparison.relation.value), negated),
                         side(comparison.right, 1));
    };
    auto text = relation(view.first, 0);
    if (view.second)
      text += fmt::format(" {} {}", (view.joint->kind == ItemKind::And) != negated ? "and" : "or",
                          relation(*view.second, 2));
    return text;
  }

  /// What must be computed before a test, because the robot always computes both its sides.
  std::vector<std::string> prepare(std::uint32_t step) {
    std::vector<std::string> lines;
    if (!hints_.prepared[step])
      return lines;
    const auto view = program_.as<compiler::IfView>(statement_of(step));
    std::uint32_t n = 0;
    for (const auto* item :
         {&view.first.left, &view.first.right, &view.second->left, &view.second->right}) {
      if (acts(program_, *item)) {
        auto& name = helpers_[{step, n}];
        if (name.empty())
          name = names_.fresh("seen");
        lines.push_back(fmt::format("{} = {}", name, value(*item)));
      }
      ++n;
    }
    return lines;
  }

  std::int32_t step_of(const compiler::ForView& loop) const {
    if (loop.step == nullptr)
      return 1;
    const auto root = loop.step->value;
    const auto& node = program_.nodes[root];
    return node.kind == compiler::NodeKind::Negate ? -program_.nodes[root - 1].value : node.value;
  }

  /// The end of a loop that is not written as `for`: a number, or the variable that keeps it.
  std::string end_of(std::uint32_t step, const compiler::ForView& loop) {
    if (program_.nodes[loop.end.value].kind == compiler::NodeKind::Number)
      return value(loop.end);
    auto& name = helpers_[{step, 0}];
    if (name.empty())
      name = names_.fresh("last_" + names_.letter(loop.variable.value));
    return name;
  }

  // ---- statements

  const StatementNode& statement_of(std::uint32_t step) const {
    return program_.statements[ways_.steps[step].statement];
  }

  std::vector<std::string> lines_of(std::uint32_t n) {
    const auto& node = graph_->nodes[n];
    if (node.kind == NodeKind::Tail)
      return {names_.sub(node.sub)};
    if (node.kind == NodeKind::Test)
      return prepare(node.step);
    if (node.step == none)
      return {"end"};
    const auto& statement = statement_of(node.step);
    if (node.kind == NodeKind::Close) {
      const auto view = program_.as<compiler::ForView>(statement_of(ways_.steps[node.step].loop));
      const auto by = step_of(view);
      return {fmt::format("{} {}= {}", letter_set(view.variable.value), by < 0 ? '-' : '+',
                          std::abs(std::int64_t{by}))};
    }
    if (node.kind == NodeKind::Begin) {
      const auto view = program_.as<compiler::ForView>(statement);
      std::vector<std::string> lines{
          fmt::format("{} = {}", letter_set(view.variable.value), value(view.start))};
      if (program_.nodes[view.end.value].kind != compiler::NodeKind::Number)
        lines.push_back(fmt::format("{} = {}", end_of(node.step, view), value(view.end)));
      return lines;
    }
    if (statement.kind == Statement::On)
      return calls(node.step);
    return {simple(node.step, statement)};
  }

  std::string simple(std::uint32_t step, const StatementNode& statement) {
    const auto word = spec::info(statement.kind).word;
    const auto items = program_.items_of(statement);
    const auto value_text = [&](const compiler::Item& item) { return value(item); };
    switch (spec::info(statement.kind).form) {
    case spec::Form::Assignment: return assignment(items[0], items[1]);
    case spec::Form::Branch: return sub_at(ways_.steps[step].targets.front());
    case spec::Form::Output: return print(items);
    case spec::Form::Entry:
      return items.size() < 2 ? fmt::format("{} {}", word, place(items[0]))
                              : fmt::format("{} {}, {}, {}", word, place(items[0]), time(items[1]),
                                            value(items[2]));
    case spec::Form::Variables:
      return words(word, items, [&](const compiler::Item& item) { return place(item); });
    case spec::Form::Values: {
      const auto most = static_cast<std::size_t>(spec::value_of(spec::Limit::DataValues));
      return words(word, items.first(std::min(items.size(), most)), value_text);
    }
    case spec::Form::Arguments:
      if (statement.kind == Statement::Sleep)
        return sleep(statement);
      if (statement.kind == Statement::Delay)
        return fmt::format("{} {}", word, time(items[0]));
      return words(word, items, value_text);
    case spec::Form::Conditional:
    case spec::Form::Loop:
    case spec::Form::LoopEnd:
    case spec::Form::IndexedBranch: break; // written as blocks
    }
    return {};
  }

  template <typename Text>
  static std::string words(std::string_view word, std::span<const compiler::Item> items,
                           Text text) {
    std::string out(word);
    for (std::size_t i = 0; i < items.size(); ++i)
      out += (i == 0 ? " " : ", ") + text(items[i]);
    return out;
  }

  std::string time(const compiler::Item& item) {
    const auto& node = program_.nodes[item.value];
    return node.kind == compiler::NodeKind::Number ? duration(node.value) : value(item);
  }

  /// `v = v + e` is `v += e`.
  std::string assignment(const compiler::Item& variable, const compiler::Item& expression) {
    const auto root = expression.value;
    const auto& node = program_.nodes[root];
    const auto op = static_cast<Operator>(node.what);
    const bool short_form = op == Operator::Add || op == Operator::Subtract ||
                            op == Operator::Multiply || op == Operator::Divide ||
                            op == Operator::Remainder;
    if (variable.kind == ItemKind::Letter && node.kind == compiler::NodeKind::Binary &&
        short_form) {
      const auto& left = program_.nodes[node.first];
      const bool same = left.kind == compiler::NodeKind::Letter && left.what == variable.value &&
                        program_.nodes[root - 1].first == node.first + 1;
      if (same) {
        read_[variable.value] = true;
        return fmt::format("{} {}= {}", place(variable), spec::info(op).symbol,
                           expression_text(inner(root - 1)));
      }
    }
    return fmt::format("{} = {}", place(variable), value(expression));
  }

  /// The first line of the program is `restart`; no line is nothing.
  std::string sleep(const StatementNode& statement) {
    const auto view = program_.as<compiler::SleepView>(statement);
    auto text = fmt::format("sleep {}", value(view.seconds));
    const bool restarts = program_.nodes[view.line.value].value != 0;
    const auto& macro = program_.nodes[view.macro.value];
    if (restarts || macro.kind != compiler::NodeKind::Number || macro.value != 0)
      text += fmt::format(", {}", value(view.macro));
    return restarts ? text + ", restart" : text;
  }

  std::string print(std::span<const compiler::Item> items) {
    std::string text = "print";
    for (std::size_t i = 0; i < items.size(); ++i) {
      const auto& item = items[i];
      const auto before = i == 0 ? ItemKind::Semicolon : items[i - 1].kind;
      if (item.kind == ItemKind::Comma) {
        text += i + 1 == items.size() ? " \" \"" : ","; // a comma at the end would go on below
      } else if (item.kind == ItemKind::Semicolon) {
        text += ";";
      } else if (item.kind == ItemKind::String) {
        text += fmt::format(" {}", program_.text_of(item.span));
      } else if (item.kind == ItemKind::Character) {
        text += fmt::format(" ${}", operand(item.value));
      } else {
        const auto shown = value(item);
        // What stands in parentheses after a name would be its arguments.
        const bool calls = shown.front() == '(' &&
                           (before == ItemKind::Expression || before == ItemKind::Character);
        text += fmt::format("{} {}", calls ? ";" : "", shown);
      }
    }
    return text;
  }

  // ---- expressions

  const std::string& letter_read(std::uint32_t which) {
    read_[which] = true;
    return names_.letter(which);
  }
  const std::string& letter_set(std::uint32_t which) {
    set_[which] = true;
    return names_.letter(which);
  }
  std::string element() {
    uses_elements_ = true;
    constexpr std::uint32_t index = 'Y' - 'A';
    return fmt::format("{}[{}]", names_.elements(), letter_read(index));
  }

  std::string place(const compiler::Item& item) {
    if (item.kind == ItemKind::Letter)
      return letter_set(item.value);
    if (item.kind == ItemKind::Indexed)
      return element();
    return std::string(spec::variables[item.value].word);
  }

  std::string value(const compiler::Item& item) { return expression_text(item.value); }

  /// What stands in parentheses, where they are all there is.
  std::uint32_t inner(std::uint32_t root) const {
    while (program_.nodes[root].kind == compiler::NodeKind::Group)
      --root;
    return root;
  }

  /// In parentheses where it has several parts.
  std::string operand(std::uint32_t root) {
    const auto kind = program_.nodes[inner(root)].kind;
    const bool parts = kind == compiler::NodeKind::Binary || kind == compiler::NodeKind::Negate;
    const auto text = expression_text(inner(root));
    return parts ? fmt::format("({})", text) : text;
  }

  std::string expression_text(std::uint32_t root) {
    const auto& node = program_.nodes[root];
    switch (node.kind) {
    case compiler::NodeKind::Number: return fmt::format("{}", node.value);
    case compiler::NodeKind::Letter: return letter_read(node.what);
    case compiler::NodeKind::Indexed: return element();
    case compiler::NodeKind::System: return std::string(program_.text_of(node.span));
    case compiler::NodeKind::Group: return operand(root);
    case compiler::NodeKind::Negate: return fmt::format("-{}", expression_text(root - 1));
    case compiler::NodeKind::Binary: {
      const auto left = program_.nodes[root - 1].first - 1;
      auto text = expression_text(left);
      text += fmt::format(" {} ", spec::operators[node.what].symbol);
      return text + expression_text(root - 1);
    }
    case compiler::NodeKind::Call:
      return fmt::format("{}({})", spec::functions[node.what].word,
                         expression_text(inner(root - 1)));
    }
    return {};
  }

  const compiler::Program& program_;
  const Ways& ways_;
  const Comments& comments_;
  const std::vector<Graph>& graphs_;
  const Proofs& proofs_;
  LiftedNames names_;
  Hints hints_;
  std::string out_;
  std::vector<std::uint32_t> lines_;
  std::uint32_t source_line_ = 0;
  const Graph* graph_ = nullptr;
  std::uint32_t routine_line_ = none;           ///< the first one of the routine
  std::map<std::uint32_t, std::string> labels_; ///< of nodes
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> helpers_; ///< variables for steps
  std::array<bool, 25> read_{};
  std::array<bool, 25> set_{};
  bool uses_elements_ = false;
  std::vector<std::uint32_t> loops_;
  std::vector<std::uint32_t> choices_;
};

} // namespace

std::size_t not_blank(std::string_view text, std::size_t end) {
  std::size_t lines = 0;
  for (std::size_t i = 0; i < end; ++i)
    lines += text[i] == '\n' && i > 0 && text[i - 1] != '\n' ? 1 : 0;
  return lines;
}

std::vector<bool> prepared_tests(const compiler::Program& program, const Ways& ways) {
  std::vector<bool> prepared(ways.steps.size(), false);
  for (std::size_t s = 0; s < ways.steps.size(); ++s) {
    const auto& statement = program.statements[ways.steps[s].statement];
    prepared[s] = statement.kind == Statement::If && is_prepared(program, statement);
  }
  return prepared;
}

LiftedText write_text(const compiler::Program& program, const Ways& ways, const Comments& comments,
                      const std::vector<Graph>& graphs, const Proofs& proofs) {
  return Writer(program, ways, comments, graphs, proofs).write();
}

} // namespace orb::structured::lifting
