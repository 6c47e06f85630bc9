#include "base/text/suggest.h"
#include "compiler/lint/line_pass.h"
#include "compiler/text/basic_words.h"
#include "compiler/text/rules.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace orb::compiler {
namespace {

/// Checks how statements and expressions are written. Large because each rule has its own member.
class StatementsPass : private LinePass {
public:
  StatementsPass(const Program& program, const Flow& flow, const Target& target, Findings& findings)
      : LinePass(program, flow, findings), target_(target) {}

  void run() {
    for (const auto& code : flow_.code)
      check_line(program_.lines[code.line]);
    check_targets();
    for (const auto& node : program_.nodes)
      if (is_remarkable(node))
        check_node(node);
  }

private:
  void check_line(const Line& line) {
    blank_missing_ = false;
    const auto& whole = program_.statements[line.statement];
    if (line.has_number() && whole.span.size() > 0 && whole.span.begin == line.number_span.end)
      add_missing_blank(line.number_span.end, texts::MissingSpaceNextToNumber());
    for (const auto& statement : program_.whole(whole)) {
      if (statement.error)
        continue;
      if (&statement != &whole)
        check_branch(statement);
      check(statement);
      if (statement.kind == spec::Statement::Print && program_.items_of(statement).empty())
        check_single_quotes(statement, line.comment);
    }
  }

  void check_branch(const StatementNode& statement) {
    const auto& row = spec::info(statement.kind);
    if (row.in_then == spec::InThen::Unlisted)
      findings_.add(rules::UndocumentedInBranch, statement.word,
                    texts::NotDocumentedInBranch(row.word), texts::MoveToOwnLine());
  }

  void check(const StatementNode& statement) {
    const auto& row = spec::info(statement.kind);
    const bool wordy = statement.word.size() > 0 && statement.spelling != Spelling::QuestionMark;
    if (wordy && statement.word.end < statement.span.end)
      check_side(statement.word.end, statement.word.end, row.word);
    switch (row.form) {
    case spec::Form::Assignment: check_let(statement); break;
    case spec::Form::Conditional: check_if(statement); break;
    case spec::Form::Loop: check_for(program_.as<ForView>(statement)); break;
    case spec::Form::IndexedBranch: check_on(statement); break;
    case spec::Form::Output: check_print(program_.items_of(statement)); break;
    case spec::Form::Values: check_data(program_.items_of(statement)); break;
    case spec::Form::Variables: check_read(statement); break;
    case spec::Form::LoopEnd:
    case spec::Form::Branch:
    case spec::Form::Entry:
    case spec::Form::Arguments: break;
    }
  }

  void check_let(const StatementNode& statement) {
    if (statement.spelling != Spelling::Let)
      return;
    auto& d = findings_.add(rules::UndocumentedLet, statement.word, texts::LetNotDocumented(),
                            texts::RemoveIt());
    const auto begin = program_.as<LetView>(statement).variable.span.begin;
    d.fix = single_fix(texts::RemoveLet(), {statement.word.begin, begin}, "");
  }

  void check_if(const StatementNode& statement) {
    const auto condition = program_.as<IfView>(statement);
    if (condition.second)
      check_gap(condition.first.right.span.end, condition.second->left.span.begin,
                condition.joint->kind == ItemKind::And ? "and" : "or");
    // An empty branch has no side for a space.
    const auto& then = program_.statements[statement.then_branch].span;
    if (then.size() == 0)
      return;
    check_gap(condition.last().right.span.end, then.begin, "then");
    if (statement.else_branch != none && program_.statements[statement.else_branch].span.size() > 0)
      check_gap(then.end, program_.statements[statement.else_branch].span.begin, "else");
  }

  void check_for(const ForView& loop) {
    check_gap(loop.start.span.end, loop.end.span.begin, "to");
    if (loop.step != nullptr)
      check_gap(loop.end.span.end, loop.step->span.begin, "step");
  }

  void check_on(const StatementNode& statement) {
    const auto& [selector, targets] = program_.as<OnView>(statement);
    check_gap(selector.span.end, targets.front().span.begin,
              statement.spelling == Spelling::OnGosub ? "gosub" : "goto");
  }

  void check_targets() {
    for (const auto& jump : flow_.jumps) {
      if (jump.to != none)
        continue;
      const auto& target = program_.items[jump.item];
      if (const auto* number = flow_.find(target.value))
        add_empty_target(target, number->line);
      else
        add_missing_target(target);
    }
  }

  void add_empty_target(const Item& target, std::uint32_t index) {
    auto& d = findings_.add(rules::EmptyTarget, target.span, texts::HasNoStatement(target.value),
                            texts::JumpBelow());
    const auto at = program_.lines.begin() + index;
    const auto below = std::find_if(at, program_.lines.end(), [](const Line& line) {
      return line.has_number() && line.has_statement();
    });
    if (below == program_.lines.end()) {
      d.help = texts::Write(fmt::format("{} end", target.value));
      d.fix = single_fix(d.help, {at->number_span.end, at->number_span.end}, " end");
    } else if (below->number < none - 1) {
      d.help = texts::JumpBelowTo(below->number);
      d.fix = single_fix(d.help, target.span, std::to_string(below->number));
    }
  }

  /// The only line number with one digit more or less: `goto 200` for `goto 20`.
  std::optional<std::uint32_t> number_like(const Item& target) const {
    constexpr std::size_t most = 256; // lines; beyond, a typo has too many candidates
    const auto written = program_.text_of(target.span);
    std::optional<std::uint32_t> meant;
    if (flow_.numbers.size() > most)
      return meant;
    for (const auto& row : flow_.numbers) {
      const auto number = std::to_string(row.number);
      const auto line = program_.lines[row.line].span;
      const bool itself = line.begin <= target.span.begin && target.span.begin < line.end;
      if (itself || number.size() == written.size() || edit_distance(number, written) != 1)
        continue;
      if (meant)
        return std::nullopt;
      meant = row.number;
    }
    return meant;
  }

  void add_missing_target(const Item& target) {
    const auto written = program_.text_of(target.span);
    auto& d = findings_.add(rules::MissingTarget, target.span, texts::NoSuchLine(written));
    if (const auto meant = number_like(target)) {
      d.fix = single_fix(texts::JumpToLine(*meant), target.span, std::to_string(*meant),
                         Safety::Unsafe);
      return;
    }
    if (!flow_.numbers.empty() && target.value < flow_.numbers.front().number) {
      const auto first = flow_.numbers.front().number;
      d.message = texts::NoSuchLineFirst(written, first);
      d.fix =
          single_fix(texts::JumpToLine(first), target.span, std::to_string(first), Safety::Unsafe);
      return;
    }
    const auto next =
        std::lower_bound(flow_.numbers.begin(), flow_.numbers.end(), target.value,
                         [](const auto& row, std::uint32_t n) { return row.number < n; });
    if (next != flow_.numbers.end())
      d.help = texts::NextLineIs(next->number);
    else if (!flow_.numbers.empty())
      d.help = texts::LastLineIs(flow_.numbers.back().number);
  }

  void check_print(std::span<const Item> items) {
    if (std::none_of(items.begin(), items.end(),
                     [](const Item& item) { return item.kind == ItemKind::Semicolon; }))
      return;
    std::string spaced; // the list with a space for each
    bool blank = false;
    for (std::size_t i = 0; i < items.size(); ++i) {
      const bool inside = items[i].kind == ItemKind::Semicolon && i + 1 < items.size();
      if (i > 0 && !inside)
        spaced += blank ? " "
                        : program_.text.substr(items[i - 1].span.end,
                                               items[i].span.begin - items[i - 1].span.end);
      if (!inside)
        spaced += program_.text_of(items[i].span);
      blank = inside;
    }
    for (std::size_t i = 0; i + 1 < items.size(); ++i)
      if (items[i].kind == ItemKind::Semicolon)
        add_semicolon(items[i], items[i + 1], spaced);
  }

  /// `print 'hello'` prints an empty line, because `'` begins a comment.
  void check_single_quotes(const StatementNode& statement, Span comment) {
    const auto text = program_.text_of(comment);
    const auto last = text.find_last_of('\'');
    if (last == 0 || last == std::string_view::npos)
      return;
    const auto rest = trim(text.substr(last + 1)); // `, A`: the rest of the print list
    if (!rest.empty() && rest[0] != ',' && rest[0] != ';')
      return;
    auto quoted = std::string(text.substr(0, last + 1));
    if (std::count(quoted.begin(), quoted.end(), '\'') % 2 == 0)
      std::replace(quoted.begin(), quoted.end(), '\'', '"'); // several texts
    else
      quoted = fmt::format("\"{}\"", text.substr(1, last - 1)); // `'it's'`
    auto& d = findings_.add(rules::SingleQuotes, {statement.span.begin, comment.end},
                            texts::StartsAComment('\''),
                            texts::Write(fmt::format("print {}{}", quoted, rest)));
    if (text.find('"') == std::string_view::npos)
      d.fix = single_fix(
          d.help, {comment.begin, comment.begin + static_cast<std::uint32_t>(last) + 1}, quoted);
  }

  void add_semicolon(const Item& semicolon, const Item& next, const std::string& spaced) {
    auto& d =
        findings_.add(rules::SemicolonInPrint, semicolon.span, texts::OnlyAtTheEnd(';', "print"),
                      texts::WriteWithSpaces(fmt::format("print {}", spaced), ','));
    // Insert a space to keep both sides apart, but not before a minus sign, which would join them.
    if (program_.text[next.span.begin] != '-')
      d.fix = single_fix(texts::WriteSpace(), {semicolon.span.begin, next.span.begin}, " ");
  }

  void check_data(std::span<const Item> values) {
    const auto count = static_cast<std::uint32_t>(values.size());
    const auto most = static_cast<std::uint32_t>(spec::value_of(spec::Limit::DataValues));
    if (count > most)
      findings_.add(rules::TooManyDataValues, values[most].span, texts::LineHasValues(count, most));
    for (const auto& value : values) {
      const auto& root = program_.nodes[value.value];
      const bool negative =
          root.kind == NodeKind::Negate && program_.nodes[value.value - 1].kind == NodeKind::Number;
      if (root.kind != NodeKind::Number && !negative) {
        findings_.add(rules::DataExpression, value.span, texts::OnlyPlainNumbers());
        break;
      }
    }
  }

  void check_read(const StatementNode& statement) {
    if (program_.items_of(statement).size() > 1)
      findings_.add(rules::ReadSeveral, statement.span, texts::OneVariablePerRead(),
                    texts::WriteOneReadEach());
  }

  /// Checks for spaces on both sides of a word between two expressions.
  void check_gap(std::uint32_t begin, std::uint32_t end, std::string_view word) {
    if (end <= begin)
      return;
    check_side(begin, begin, word);
    check_side(end - 1, end, word);
  }

  void add_missing_blank(std::uint32_t at, Message message) {
    if (blank_missing_)
      return; // one finding per line is enough
    blank_missing_ = true;
    auto& d = findings_.add(rules::MissingBlank, {at, at}, std::move(message));
    d.fix = single_fix(texts::InsertSpace(), {at, at}, " ");
    const auto text = std::string_view(program_.text).substr(at);
    const auto alike = std::min(text.find_first_not_of("OoLlIi"), text.size());
    const bool digit = alike > 0 && (alike == text.size() || is_blank(text[alike])) && at > 0 &&
                       is_digit(program_.text[at - 1]);
    if (digit)
      d.fix->safety = Safety::Unsafe; // `12O goto 10` is line 120
  }

  void check_node(const Node& node) {
    switch (node.kind) {
    case NodeKind::Number:
      if (node.overflow)
        findings_.add(rules::LiteralTooLarge, node.span,
                      texts::IsAbove(program_.text_of(node.span),
                                     spec::value_of(spec::Limit::GreatestInteger)));
      break;
    case NodeKind::System: check_system(node); break;
    case NodeKind::Group: check_depth(node); break;
    case NodeKind::Negate:
      if (!follows_step(node.span.begin))
        add_negative(node);
      break;
    case NodeKind::Call:
      check_depth(node);
      check_operand(node, (&node)[-1]);
      break;
    case NodeKind::Letter:
    case NodeKind::Indexed:
    case NodeKind::Binary: break;
    }
  }

  /// True if the sign after `step` is here: it is documented.
  bool follows_step(std::uint32_t at) const {
    constexpr std::string_view word = "step";
    while (at > 0 && is_blank(program_.text[at - 1]))
      --at;
    return program_.text.substr(0, at).ends_with(word);
  }

  void check_depth(const Node& node) {
    const auto most = spec::value_of(spec::Limit::ExpressionLevels);
    if (node.depth == most + 1)
      findings_.add(rules::ExpressionLevels, node.span, texts::MoreLevelsThan(most),
                    texts::ComputeSeparately());
  }

  void add_negative(const Node& node) {
    auto& d = findings_.add(rules::NegativeLiteral, node.span, texts::NegativeNotDocumented(),
                            texts::Write("0-…"));
    const auto version = target_.version;
    if (version == spec::BasicVersion::V0_9)
      d.severity = Severity::Error;
    // After an operator, or before one that binds more strongly than minus, only parentheses keep
    // the sign with its operand.
    auto before = node.span.begin;
    while (before > 0 && is_blank(program_.text[before - 1]))
      --before;
    auto after = node.span.end;
    while (after < program_.text.size() && is_blank(program_.text[after]))
      ++after;
    const bool bound = before > 0 && spec::find_operator(program_.text[before - 1]);
    const auto next = after < program_.text.size() ? spec::find_operator(program_.text[after])
                                                   : std::optional<spec::Operator>();
    const bool binds = next && spec::info(*next).level == spec::Level::Medium;
    const auto begin = node.span.begin;
    if (!bound && !binds) {
      d.help = texts::Write(fmt::format("0{}", program_.text_of(node.span)));
      d.fix = single_fix(d.help, {begin, begin}, "0");
      return;
    }
    d.help = texts::Write(fmt::format("(0{})", program_.text_of(node.span)));
    // Each enclosing function may get parentheses in the same round, which count too.
    if (2 * node.depth + 1 + deepest_below(node) <= spec::value_of(spec::Limit::ExpressionLevels))
      d.fix = Fix{d.help,
                  {{{begin, begin}, "(0"}, {{node.span.end, node.span.end}, ")"}},
                  // `N -- 1` is more often a sign too many than a negative number.
                  begin > 0 && program_.text[begin - 1] == '-' ? Safety::Unsafe : Safety::Safe};
  }

  void check_system(const Node& node) {
    const auto& row = spec::variables[node.what];
    const bool old_name = !row.old_word.empty() && program_.text_of(node.span) == row.old_word;
    if (old_name && target_.version >= row.since) {
      auto& d = findings_.add(rules::OldName, node.span,
                              texts::WasRenamed(row.old_word, row.word, spec::info(row.since).text),
                              texts::Write(row.word));
      d.fix = single_fix(d.help, node.span, std::string(row.word));
    }
  }

  /// the operand is the whole expression that follows. That surprises if a weak operator
  /// follows, or anything after a parenthesis.
  void check_operand(const Node& node, const Node& operand) {
    const auto& row = spec::functions[node.what];
    if (operand.kind != NodeKind::Binary)
      return;
    const auto& op = spec::operators[operand.what];
    const bool parenthesis = program_.text[operand.span.begin] == '(';
    if (op.level != spec::Level::Low && !parenthesis)
      return;
    const auto& first = first_operand(operand, parenthesis);
    const auto rest = program_.text_of({first.span.end, operand.span.end});
    const auto all = fmt::format("{} ({})", row.word, program_.text_of(operand.span));
    const auto less = fmt::format("({} {}){}", row.word, inner_text(first), rest);
    auto& d = findings_.add(rules::FunctionOperand, node.span,
                            texts::AppliesToAllOf(row.word, program_.text_of(operand.span)));
    // A call as in other languages, constants that nobody would leave to the robot to add, or a sum
    // of calls.
    if (parenthesis || is_constant(operand) || holds_call(operand)) {
      d.help = texts::WriteOrForAll(less, all);
      d.fix = single_fix(d.help, {node.span.begin, operand.span.end}, less, Safety::Unsafe);
      return;
    }
    d.help = texts::WriteOrForLess(all, less);
    // Other fixes of the same round may put parentheses around this operand and into it.
    const int levels = node.depth + 1 + (node.depth - 1) + deepest_below(operand);
    if (levels <= spec::value_of(spec::Limit::ExpressionLevels))
      d.fix = Fix{texts::PutInParentheses(),
                  {{{operand.span.begin, operand.span.begin},
                    program_.text[operand.span.begin - 1] == ' ' ? "(" : " ("},
                   {{operand.span.end, operand.span.end}, ")"}},
                  Safety::Safe};
  }

  /// The first operand within the operand of a function, up to the first operator of low level, or
  /// of any level if `all`.
  const Node& first_operand(const Node& root, bool all) const {
    const auto* node = &root;
    while (node->kind == NodeKind::Binary &&
           (all || spec::operators[node->what].level == spec::Level::Low)) {
      const auto right = static_cast<std::uint32_t>(node - program_.nodes.data()) - 1;
      node = &program_.nodes[program_.nodes[right].first - 1];
    }
    return *node;
  }

  std::string_view inner_text(const Node& node) const {
    const auto& inner = node.kind == NodeKind::Group ? (&node)[-1] : node;
    return program_.text_of(inner.span);
  }

  bool is_constant(const Node& root) const {
    const auto* const first = program_.nodes.data() + root.first;
    return std::all_of(first, &root, [](const Node& node) {
      return node.kind == NodeKind::Number || node.kind == NodeKind::Binary;
    });
  }

  bool holds_call(const Node& root) const {
    const auto* const first = program_.nodes.data() + root.first;
    return std::any_of(first, &root, [](const Node& node) { return node.kind == NodeKind::Call; });
  }

  /// The greatest depth of a subtree after fixes: functions and signs count twice.
  int deepest_below(const Node& root) const {
    int levels = 0;
    const auto index = static_cast<std::uint32_t>(&root - program_.nodes.data());
    for (auto i = root.first; i < index; ++i) {
      const auto kind = program_.nodes[i].kind;
      levels += kind == NodeKind::Group || kind == NodeKind::Negate ? 1 : 0;
      levels += kind == NodeKind::Call ? 2 : 0;
    }
    return levels;
  }

  /// Checks for a space at `at`; the fix inserts it at `gap`.
  void check_side(std::uint32_t at, std::uint32_t gap, std::string_view word) {
    if (!is_blank(program_.text[at]))
      add_missing_blank(gap, texts::MissingSpaceNextTo(word));
  }

  /// True if a node may have a finding; most cannot.
  bool is_remarkable(const Node& node) const {
    if (node.kind != NodeKind::System)
      return node.kind > NodeKind::Binary || node.overflow;
    return !spec::variables[node.what].old_word.empty();
  }

  const Target& target_;
  bool blank_missing_ = false; ///< a missing space was reported on this line
};

} // namespace

void lint_statements(const Program& program, const Flow& flow, const Target& target,
                     Findings& findings) {
  StatementsPass(program, flow, target, findings).run();
}

} // namespace orb::compiler
