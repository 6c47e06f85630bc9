#pragma once

#include "base/text/text.h"
#include "structured/text/messages.h"
#include "structured/text/program.h"
#include "structured/text/structured_words.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <string_view>
#include <utility>
#include <vector>

namespace orb::structured {

/// Ends the parse of a line. Never leaves structured/text/parse_structured.cpp.
struct ParseStop {
  Reason reason;
  const char* begin;
  const char* end = nullptr; ///< null: the span is the token at `begin`
};

/// Stores the parse results directly in the program.
class Builder {
public:
  explicit Builder(Program& program)
      : program_(program), base_(program.text.data()), slots_(1024, none) {
    for (std::uint32_t i = 0; i < program.names.size(); ++i)
      place(i);
  }

  Span span(const char* begin, const char* end) const {
    return {static_cast<std::uint32_t>(begin - base_), static_cast<std::uint32_t>(end - base_)};
  }

  // ---- names

  std::uint32_t intern(Span name) {
    auto at = slot_of(program_.text_of(name));
    for (; slots_[at] != none; at = next_slot(at))
      if (equal_words(program_.name(slots_[at]), program_.text_of(name)))
        return slots_[at];
    program_.names.push_back(name);
    slots_[at] = size(program_.names) - 1;
    if (program_.names.size() * 2 > slots_.size()) {
      slots_.assign(slots_.size() * 4, none);
      for (std::uint32_t i = 0; i < program_.names.size(); ++i)
        place(i);
    }
    return size(program_.names) - 1;
  }

  // ---- expressions

  void leaf(NodeKind kind, std::uint8_t what, std::int32_t value, Span where) {
    program_.nodes.push_back({kind, what, 0, size(program_.nodes), value, where});
  }
  /// Adds a node over all nodes from `first`.
  void over(NodeKind kind, std::uint8_t what, std::uint32_t first, Span where) {
    program_.nodes.push_back({kind, what, 0, first, 0, where});
  }
  void unary(NodeKind kind, std::uint8_t what, Span where) {
    over(kind, what, program_.nodes.back().first, where);
  }
  void binary(NodeKind kind, std::uint8_t what) {
    const auto left = program_.nodes.back().first - 1;
    const auto end = whole(nodes() - 1).end;
    over(kind, what, program_.nodes[left].first, {whole(left).begin, end});
  }
  /// The place of an operand with the brackets around it. Drops the groups in it.
  Span whole(std::uint32_t node) {
    const bool grouped = !groups_.empty() && groups_.back().node == node;
    const auto span = grouped ? groups_.back().span : program_.nodes[node].span;
    while (!groups_.empty() && groups_.back().node >= program_.nodes[node].first)
      groups_.pop_back();
    return span;
  }
  void operation(char sign) {
    binary(NodeKind::Binary, static_cast<std::uint8_t>(*spec::find_operator(sign)));
  }
  void relation(const char* begin) {
    const std::string_view two(begin, 2);
    auto comparison = Comparison::Equal;
    if (two == "<>" || two == "!=" || *begin == '!')
      comparison = Comparison::NotEqual;
    else if (two == "<=")
      comparison = Comparison::LessEqual;
    else if (two == ">=")
      comparison = Comparison::GreaterEqual;
    else if (*begin == '<')
      comparison = Comparison::Less;
    else if (*begin == '>')
      comparison = Comparison::Greater;
    binary(NodeKind::Relation, static_cast<std::uint8_t>(comparison));
  }
  std::uint32_t nodes() const { return size(program_.nodes); }
  Node& last() { return program_.nodes.back(); }

  void open(const char* at) {
    ++brackets_;
    if (++depth_ > deepest)
      throw ParseStop{Reason::TooDeep, at};
  }
  void close() {
    --brackets_;
    --depth_;
  }
  /// Ends a group in parentheses, whose root is the last node.
  void close_group(Span span) {
    close();
    groups_.push_back({nodes() - 1, span});
  }
  void open_not(const char* at) {
    if (++depth_ > deepest)
      throw ParseStop{Reason::TooDeep, at};
  }
  void close_not() { --depth_; }
  bool in_brackets() const { return brackets_ > 0; }

  // ---- statements

  void item(ItemKind kind, std::uint32_t value, Span where) {
    program_.items.push_back({kind, value, where});
  }
  void expression(ItemKind kind) { item(kind, nodes() - 1, program_.nodes.back().span); }
  void widen_item(const char* begin) {
    program_.items.back().span.begin = span(begin, begin).begin;
  }

  Statement& begin(Kind kind, Span word) {
    auto& statement = program_.statements.emplace_back();
    statement.kind = kind;
    statement.word = word;
    statement.span = word;
    statement.items_begin = statement.items_end = size(program_.items);
    return statement;
  }
  Statement& statement() { return program_.statements.back(); }
  void finish(const char* end) {
    auto& last = statement();
    last.items_end = size(program_.items);
    const auto begin = base_ + last.span.begin;
    while (end > begin && (is_blank(end[-1]) || is_line_end(end[-1])))
      --end;
    last.span.end = std::max(last.span.end, static_cast<std::uint32_t>(end - base_));
  }

  struct Mark {
    std::size_t statements;
    std::size_t items;
    std::size_t nodes;
    std::size_t diagnostics;
  };
  Mark mark() const {
    return {program_.statements.size(), program_.items.size(), program_.nodes.size(),
            program_.diagnostics.size()};
  }
  /// Replaces everything since `mark` by one broken statement.
  void fail(const Mark& mark, const ParseStop& stop, const char* begin, const char* limit) {
    const auto meant = meaning_of(mark, stop, limit);
    auto& said = program_.diagnostics;
    const bool foreign = said.size() > mark.diagnostics; // its finding says more
    program_.statements.resize(mark.statements);
    program_.items.resize(mark.items);
    program_.nodes.resize(mark.nodes);
    said.resize(mark.diagnostics + (foreign ? 1 : 0));
    const auto found = stop.end != nullptr ? span(stop.begin, stop.end) : token(stop.begin, limit);
    const auto reason = is_second_index(stop.reason, found) ? Reason::SecondIndex : stop.reason;
    if (foreign)
      said.back().fix.reset();
    else if (!is_said(reason, found))
      report(explain(program_, reason, found));
    this->begin(Kind::Broken, span(begin, begin)).meant = meant;
    begin_line();
  }
  void begin_line() {
    depth_ = brackets_ = 0;
    groups_.clear();
  }

  void report(Diagnostic diagnostic) { program_.diagnostics.push_back(std::move(diagnostic)); }
  Program& program() { return program_; }

  /// The word, number, text or sign at `at`; empty at the end of a line.
  Span token(const char* at, const char* end) const {
    const char* p = at;
    if (p == end || is_line_end(*p) || *p == '\'')
      return span(at, at);
    if (is_name_char(*p))
      p = end_of_name(p, end);
    else if (*p == '"')
      p = std::find_if(p, end, is_line_end);
    else
      do
        ++p;
      while (p != end && is_utf8_tail(*p));
    return span(at, p);
  }

private:
  static constexpr int deepest = 64; ///< open brackets

  bool is_second_index(Reason reason, Span found) const {
    const auto sign = program_.text_of(found);
    auto above = std::string_view(program_.text).substr(0, found.begin);
    above.remove_prefix(std::min(above.find_last_of("\r\n") + 1, above.size()));
    const auto before = above.find_last_not_of(" \t");
    return above.find('[') != std::string_view::npos &&
           ((reason == Reason::ExpectedBracket && sign == ",") ||
            (sign == "[" && above[before] == ']'));
  }

  /// True if a line above has the same cause: a name that is too long, a second index.
  bool is_said(Reason reason, Span found) {
    const auto text = program_.text_of(found);
    const bool index = reason == Reason::SecondIndex;
    if (!index && reason != Reason::NameTooLong)
      return false;
    const auto same = [&](Span other) {
      return index || equal_words(program_.text_of(other), text);
    };
    auto& said = index ? indexed_ : long_;
    if (std::any_of(said.begin(), said.end(), same))
      return true;
    said.push_back(found);
    return false;
  }

  /// The kind of statement that the line at `mark` was meant to be. An `if` opens a block only if
  /// the line ends with its condition: otherwise a statement may have been meant to follow.
  Kind meaning_of(const Mark& mark, const ParseStop& stop, const char* limit) const {
    if (mark.statements == program_.statements.size())
      return Kind::Broken;
    const auto& first = program_.statements[mark.statements];
    const std::string_view line(
        stop.begin,
        static_cast<std::size_t>(std::find_if(stop.begin, limit, is_line_end) - stop.begin));
    const auto rest = trim(line.substr(0, std::min(line.find_first_of("'#"), line.find("//"))));
    const bool ends = rest.empty() || rest.ends_with(':') || rest.ends_with('{') ||
                      (rest.size() > 3 && equal_words(rest.substr(rest.size() - 4), "then"));
    return first.one_line || (first.kind == Kind::If && !ends) ? Kind::Broken : first.kind;
  }

  template <typename T>
  static std::uint32_t size(const std::vector<T>& vector) {
    return static_cast<std::uint32_t>(vector.size());
  }
  std::size_t slot_of(std::string_view name) const {
    std::uint64_t hash = 0xCBF29CE484222325U;
    for (const char c : name)
      hash = (hash ^ static_cast<unsigned char>(to_lower(c))) * 0x100000001B3U;
    return static_cast<std::size_t>(hash ^ hash >> 32) & (slots_.size() - 1);
  }
  std::size_t next_slot(std::size_t slot) const { return (slot + 1) & (slots_.size() - 1); }
  void place(std::uint32_t index) {
    auto at = slot_of(program_.name(index));
    while (slots_[at] != none)
      at = next_slot(at);
    slots_[at] = index;
  }

  Program& program_;
  const char* base_;
  struct Group {
    std::uint32_t node = 0; ///< its root
    Span span;              ///< with its parentheses
  };
  std::vector<Group> groups_;        ///< that no operation has taken up yet
  std::vector<std::uint32_t> slots_; ///< hash table of names; the size is a power of two
  std::vector<Span> long_;           ///< names that are too long
  std::vector<Span> indexed_;        ///< places of second indices
  int depth_ = 0;
  int brackets_ = 0;
};

} // namespace orb::structured
