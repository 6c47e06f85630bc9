#include "compiler/text/print.h"

#include "compiler/text/basic_words.h"
#include "spec/limits.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

namespace orb::compiler {
namespace {

bool is_word_char(char c) {
  return is_letter(c) || is_digit(c);
}

/// Strips leading zeros.
std::string_view strip_zeros(std::string_view digits) {
  while (digits.size() > 1 && digits.front() == '0')
    digits.remove_prefix(1);
  return digits;
}

/// Prints statements token by token. The canonical layout puts spaces where they are customary; the
/// packed layout keeps only those that separate two tokens.
class Printer {
public:
  Printer(const Program& program, Layout layout) : program_(program), layout_(layout) {}

  std::string print(const StatementNode& statement) {
    put_statement(statement);
    return std::move(out_);
  }

private:
  bool packed() const { return layout_ == Layout::Packed; }

  void blank() { blank_wanted_ = true; }

  void put(std::string_view token) {
    if (token.empty())
      return;
    if (!out_.empty()) {
      const char last = out_.back();
      const bool would_join = is_word_char(last) && is_word_char(token.front());
      // `Z(` is an error, not an index: keep `Z` and a parenthesis apart.
      const bool indexed = (last == 'Z' || last == 'z') && token.front() == '(';
      if (would_join || indexed || (blank_wanted_ && !packed()))
        out_ += ' ';
    }
    blank_wanted_ = false;
    out_ += token;
  }

  void put_statement(const StatementNode& statement) {
    if (statement.error) {
      put(program_.text_of(statement.span));
      return;
    }
    put_word(statement);
    switch (spec::info(statement.kind).form) {
    case spec::Form::Assignment: put_assignment(program_.as<LetView>(statement)); break;
    case spec::Form::Conditional: put_conditional(statement); break;
    case spec::Form::Loop: put_loop(program_.as<ForView>(statement)); break;
    case spec::Form::IndexedBranch: {
      const auto on = program_.as<OnView>(statement);
      put_item(on.selector);
      put_sign(statement.spelling == Spelling::OnGosub ? "gosub" : "goto");
      put_list(on.targets);
      break;
    }
    case spec::Form::Output: put_output(statement); break;
    case spec::Form::LoopEnd:
    case spec::Form::Branch:
    case spec::Form::Entry:
    case spec::Form::Values:
    case spec::Form::Variables:
    case spec::Form::Arguments: put_list(program_.items_of(statement)); break;
    }
  }

  void put_word(const StatementNode& statement) {
    const bool keeps_word = statement.spelling != Spelling::Let || !packed();
    if (statement.kind == spec::Statement::Print && packed())
      put("?");
    else if (statement.word.size() > 0 && keeps_word)
      put(program_.text_of(statement.word));
    blank();
  }

  /// Prints a sign or a word with a space on both sides.
  void put_sign(std::string_view sign) {
    blank();
    put(sign);
    blank();
  }

  void put_list(std::span<const Item> items) {
    for (const auto& part : items) {
      if (&part != items.data())
        put(",");
      put_item(part);
    }
  }

  void put_assignment(const LetView& let) {
    put_item(let.variable);
    put_sign("=");
    put_item(let.expression);
  }

  void put_loop(const ForView& loop) {
    put_item(loop.variable);
    put_sign("=");
    put_item(loop.start);
    put_sign("to");
    put_item(loop.end);
    if (loop.step == nullptr)
      return;
    put_sign("step");
    put_item(*loop.step);
  }

  void put_conditional(const StatementNode& statement) {
    for (const auto& part : program_.items_of(statement)) {
      if (part.kind == ItemKind::Expression)
        put_item(part);
      else
        put_sign(program_.text_of(part.span));
    }
    put_sign("then");
    put_statement(program_.statements[statement.then_branch]);
    if (statement.else_branch == none)
      return;
    put_sign("else");
    put_statement(program_.statements[statement.else_branch]);
  }

  void put_output(const StatementNode& statement) {
    const auto items = program_.items_of(statement);
    for (const auto& part : items) {
      const bool sign = part.kind == ItemKind::Comma || part.kind == ItemKind::Semicolon;
      if (sign && &part != items.data())
        blank_wanted_ = false;
      put_item(part);
      blank();
    }
  }

  void put_item(const Item& part) {
    switch (part.kind) {
    case ItemKind::Expression: put_expression(part.value); break;
    case ItemKind::Character:
      put("$");
      put_expression(part.value);
      break;
    case ItemKind::Target: put(strip_zeros(program_.text_of(part.span))); break;
    case ItemKind::String:
    case ItemKind::Comma:
    case ItemKind::Semicolon:
    case ItemKind::Letter:
    case ItemKind::Indexed:
    case ItemKind::System:
    case ItemKind::Relation:
    case ItemKind::And:
    case ItemKind::Or: put(program_.text_of(part.span)); break;
    }
  }

  /// Copies the tokens of an expression in text order.
  void put_expression(std::uint32_t root) {
    dropped_.clear();
    if (packed())
      drop_groups(root);
    const auto& node = program_.nodes[root];
    const auto text = program_.text;
    bool operand_next = true;
    for (auto i = node.span.begin; i < node.span.end;) {
      const char c = text[i];
      if (is_blank(c)) {
        ++i;
        continue;
      }
      auto end = i + 1;
      if (is_word_char(c))
        while (end < node.span.end && (is_letter(c) ? is_letter(text[end]) : is_digit(text[end])))
          ++end;
      const auto token = text.substr(i, end - i);
      if (is_digit(c)) {
        put(strip_zeros(token));
        operand_next = false;
      } else if (is_letter(c)) {
        put(token);
        operand_next = find_word(token).kind == WordKind::Function;
        if (operand_next)
          blank();
      } else if (c == '(' || c == ')') {
        if (!std::binary_search(dropped_.begin(), dropped_.end(), i))
          put(token);
        operand_next = c == '(';
      } else if (operand_next) {
        put(token); // a minus sign
      } else {
        put_sign(token);
        operand_next = true;
      }
      i = end;
    }
  }

  // ---- redundant parentheses

  const Node& node(std::uint32_t index) const { return program_.nodes[index]; }

  /// The node inside all parentheses around it.
  std::uint32_t inside(std::uint32_t index) const {
    while (node(index).kind == NodeKind::Group)
      --index;
    return index;
  }

  /// True if a function is at the right end: text after it would become part of its operand.
  bool ends_open(std::uint32_t index) const {
    while (node(index).kind == NodeKind::Binary || node(index).kind == NodeKind::Negate)
      --index;
    return node(index).kind == NodeKind::Call;
  }

  bool begins_with_sign(std::uint32_t index) const {
    return program_.text[node(node(index).first).span.begin] == '-' ||
           program_.text[node(index).span.begin] == '-';
  }

  /// True if the parentheses follow the word of a function and contain more than one operand. That
  /// a function takes the whole expression is a decision, not documented, so these
  /// parentheses stay.
  bool bounds_operand(std::uint32_t index) const {
    if (node(inside(index)).kind != NodeKind::Binary)
      return false;
    auto at = node(index).span.begin;
    while (at > 0 && is_blank(program_.text[at - 1]))
      --at;
    auto begin = at;
    while (begin > 0 && is_letter(program_.text[begin - 1]))
      --begin;
    return find_word(program_.text.substr(begin, at - begin)).kind == WordKind::Function;
  }

  void drop(const Node& group) {
    if (bounds_operand(static_cast<std::uint32_t>(&group - program_.nodes.data())))
      return;
    dropped_.push_back(group.span.begin);
    dropped_.push_back(group.span.end - 1);
  }

  /// Finds the parentheses that do not change how the expression is read.
  void drop_groups(std::uint32_t root) {
    const auto first = node(root).first;
    const auto most = spec::value_of(spec::Limit::ExpressionLevels);
    for (auto i = first; i <= root; ++i)
      if (node(i).depth > most)
        return; // the robot stops at such an expression; without them it would not
    for (auto i = first; i <= root; ++i)
      switch (node(i).kind) {
      case NodeKind::Binary: {
        const auto level = spec::operators[node(i).what].level;
        drop_operand(node(i - 1).first - 1, level, Side::Left);
        drop_operand(i - 1, level, Side::Right);
        break;
      }
      case NodeKind::Group:
        if (node(i - 1).kind == NodeKind::Group)
          drop(node(i - 1));
        break;
      case NodeKind::Call: drop_whole(i - 1); break;
      case NodeKind::Number:
      case NodeKind::Letter:
      case NodeKind::Indexed:
      case NodeKind::System:
      case NodeKind::Negate: break;
      }
    drop_whole(root);
    std::sort(dropped_.begin(), dropped_.end());
  }

  /// Drops a group that is the whole expression.
  void drop_whole(std::uint32_t index) {
    if (node(index).kind == NodeKind::Group && !begins_with_sign(inside(index)))
      drop(node(index));
  }

  enum class Side : std::uint8_t { Left, Right };
  void drop_operand(std::uint32_t index, spec::Level level, Side side) {
    if (node(index).kind != NodeKind::Group)
      return;
    const auto content = inside(index);
    if (begins_with_sign(content) || ends_open(content))
      return;
    if (node(content).kind == NodeKind::Binary) {
      const auto inner = spec::operators[node(content).what].level;
      if (side == Side::Right ? inner <= level : inner < level)
        return;
    }
    drop(node(index));
  }

  const Program& program_;
  Layout layout_;
  std::string out_;
  bool blank_wanted_ = false;
  std::vector<std::uint32_t> dropped_; ///< positions of omitted parentheses, ascending
};

} // namespace

std::string print(const Program& program, const StatementNode& statement, Layout layout) {
  return Printer(program, layout).print(statement);
}

std::string format(const Program& program) {
  std::string out;
  bool blank_pending = false;
  for (const auto& line : program.lines) {
    std::string text;
    if (line.number_span.size() > 0)
      text += strip_zeros(program.text_of(line.number_span));
    if (line.has_statement()) {
      const auto statement = print(program, program.statements[line.statement], Layout::Canonical);
      if (!text.empty() && !statement.empty())
        text += ' ';
      text += statement;
    }
    if (line.comment.size() > 0) {
      if (!text.empty())
        text += ' ';
      text += trim(program.text_of(line.comment));
    }
    if (text.empty()) {
      blank_pending = !out.empty();
      continue;
    }
    if (blank_pending)
      out += '\n';
    blank_pending = false;
    out += text;
    out += '\n';
  }
  return out;
}

} // namespace orb::compiler
