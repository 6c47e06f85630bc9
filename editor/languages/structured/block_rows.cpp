#include "editor/languages/structured/block_rows.h"

#include "base/source.h"
#include "spec/basic.h"
#include "spec/colours.h"
#include "structured/layout/layout.h"
#include "structured/text/link_blocks.h"
#include "structured/text/parse_structured.h"
#include "structured/text/structured_words.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace orb::editor {
namespace {

using namespace structured;
using Json = nlohmann::ordered_json;

/// Deeper expressions are shown as text.
constexpr std::size_t deepest_expression = 64;
constexpr std::size_t most_items = 64;
constexpr std::uint16_t deepest_block = 64;

std::string_view name_of(Kind kind) {
  switch (kind) {
  case Kind::Robot: return "robot";
  case Kind::Assign: return "assign";
  case Kind::Print: return "print";
  case Kind::Const: return "const";
  case Kind::Local: return "local";
  case Kind::Array: return "array";
  case Kind::Use: return "use";
  case Kind::Include: return "include";
  case Kind::If: return "if";
  case Kind::ElseIf: return "elseif";
  case Kind::Else: return "else";
  case Kind::EndIf: return "end if";
  case Kind::While: return "while";
  case Kind::EndWhile: return "end while";
  case Kind::Repeat: return "repeat";
  case Kind::Until: return "until";
  case Kind::RepeatTimes: return "repeat times";
  case Kind::EndRepeat: return "end repeat";
  case Kind::Loop: return "loop";
  case Kind::EndLoop: return "end loop";
  case Kind::For: return "for";
  case Kind::Next: return "next";
  case Kind::Exit: return "exit";
  case Kind::Continue: return "continue";
  case Kind::Select: return "select";
  case Kind::Case: return "case";
  case Kind::EndSelect: return "end select";
  case Kind::Sub: return "sub";
  case Kind::EndSub: return "end sub";
  case Kind::Function: return "function";
  case Kind::EndFunction: return "end function";
  case Kind::Return: return "return";
  case Kind::Call: return "call";
  case Kind::Label: return "label";
  case Kind::Goto: return "goto";
  case Kind::Broken: break;
  }
  return "text";
}

std::string_view name_of(ItemKind kind) {
  switch (kind) {
  case ItemKind::Expression: return "expression";
  case ItemKind::Place: return "place";
  case ItemKind::Character: return "character";
  case ItemKind::String: return "string";
  case ItemKind::Comma: return "comma";
  case ItemKind::Semicolon: return "semicolon";
  case ItemKind::Name: return "name";
  case ItemKind::To: return "to";
  case ItemKind::Colour: return "colour";
  case ItemKind::Restart: return "restart";
  }
  return {};
}

/// The name of what follows a statement's word.
std::string_view name_of(spec::Form form) {
  switch (form) {
  case spec::Form::Arguments: return "arguments";
  case spec::Form::Values: return "values";
  case spec::Form::Variables: return "places";
  case spec::Form::Entry: return "entry";
  case spec::Form::Assignment:
  case spec::Form::Conditional:
  case spec::Form::Loop:
  case spec::Form::LoopEnd:
  case spec::Form::Branch:
  case spec::Form::IndexedBranch:
  case spec::Form::Output: break;
  }
  return "own";
}

class Tree {
public:
  explicit Tree(std::string_view text) : source_("", std::string(text)) {
    parse(program_, "", "", source_.text());
    lines_ = lay_out(program_);
  }

  std::string print() {
    find_blocks();
    measure_expressions();
    auto rows = Json::array();
    for (std::size_t at = 0; at < lines_.size();)
      rows.push_back(row(at));
    return Json({{"rows", std::move(rows)}}).dump(-1, ' ', false, Json::error_handler_t::replace);
  }

private:
  const Statement& statement(std::uint32_t i) const { return program_.statements[i]; }

  // ---- statements with a structured form

  /// A block has one if all its parts do, down to its end.
  void find_blocks() {
    shown_.assign(program_.statements.size(), true);
    for (std::uint32_t i = 0; i < program_.statements.size(); ++i) {
      const auto& one = statement(i);
      if (one.kind == Kind::Broken || (one.opener == none && !opens_block(one.kind) &&
                                       (parts_block(one.kind) || closes_block(one.kind))))
        shown_[i] = false;
      if (opens_block(one.role()) && one.opener == none && !is_whole(i))
        for (auto part = i; part != none; part = statement(part).next)
          shown_[part] = false;
    }
  }

  bool is_whole(std::uint32_t opener) const {
    const auto& first = statement(opener);
    const bool routine = first.kind == Kind::Sub || first.kind == Kind::Function;
    if (first.depth >= deepest_block || (routine && first.depth > 0))
      return false;
    auto last = opener;
    for (auto part = opener; part != none; part = statement(part).next) {
      if (statement(part).kind == Kind::Broken)
        return false;
      last = part;
    }
    return last != opener && closes_block(statement(last).kind);
  }

  void measure_expressions() {
    for (std::uint32_t n = 0; n < program_.nodes.size(); ++n) {
      const auto operands = operands_of(n);
      std::uint8_t deepest = 0;
      for (const auto operand : operands)
        deepest = std::max(deepest, measures_[operand].depth);
      Measure measure{program_.nodes[n].span, 0,
                      static_cast<std::uint8_t>(std::min<int>(deepest + 1, deepest_expression))};
      if (const auto kind = program_.nodes[n].kind; stands_between(kind))
        measure.outside = {measures_[operands.front()].outside.begin,
                           measures_[operands.back()].outside.end};
      else if (kind == NodeKind::Negate || kind == NodeKind::Not)
        measure.outside.end = measures_[operands.back()].outside.end;
      while (take_group(measure.outside))
        ++measure.groups;
      measures_.push_back(measure);
    }
  }

  static bool stands_between(NodeKind kind) {
    return kind == NodeKind::Binary || kind == NodeKind::Relation || kind == NodeKind::And ||
           kind == NodeKind::Or;
  }

  /// Extends a span to the parentheses around it, except those of a call.
  bool take_group(Span& span) const {
    const std::string_view text = program_.text;
    const auto is_space = [](char c) { return is_blank(c) || is_line_end(c); };
    auto begin = span.begin;
    while (begin > 0 && is_space(text[begin - 1]))
      --begin;
    auto end = span.end;
    while (end < text.size() && is_space(text[end]))
      ++end;
    if (begin == 0 || text[begin - 1] != '(' || end == text.size() || text[end] != ')')
      return false;
    auto word_end = --begin;
    while (word_end > 0 && is_blank(text[word_end - 1]))
      --word_end;
    auto word = word_end;
    while (word > 0 && is_name_char(text[word - 1]))
      --word;
    const auto before = find_word(text.substr(word, word_end - word));
    if (word < word_end && (before.kind == WordKind::Name || is_function(before)))
      return false;
    span = {begin, end + 1};
    return true;
  }

  std::vector<std::uint32_t> operands_of(std::uint32_t root) const {
    std::vector<std::uint32_t> operands;
    for (auto at = root; at > program_.nodes[root].first; at = program_.nodes[at - 1].first)
      operands.push_back(at - 1);
    std::reverse(operands.begin(), operands.end());
    return operands;
  }

  bool is_handy(const Statement& one) const {
    const auto items = program_.items_of(one);
    return items.size() <= most_items &&
           std::all_of(items.begin(), items.end(), [&](const Item& item) {
             return !has_node(item) || measures_[item.value].depth < deepest_expression;
           });
  }
  static bool has_node(const Item& item) {
    return item.kind == ItemKind::Expression || item.kind == ItemKind::Place ||
           item.kind == ItemKind::Character;
  }

  // ---- rows

  /// Returns the row that begins on line `at`, and moves `at` past it.
  Json row(std::size_t& at) {
    const auto first = at;
    const auto& line = lines_[first];
    if (line.statements_begin == line.statements_end)
      return comment_row(lines_[at++]);
    const bool shown = shows(line);
    at = shown ? end_of_statements(first) : end_of_text(first);
    auto made = place(first, at);
    if (!shown) {
      made["kind"] = name_of(Kind::Broken);
      auto& texts = made["lines"] = Json::array();
      for (auto n = source_.position(line.source.begin).line;
           n <= source_.position(lines_[at - 1].source.begin).line; ++n)
        texts.push_back(source_.line(n));
      return made;
    }
    describe(made, line.statements_begin);
    if (statement(line.statements_begin).one_line)
      add_branches(made, line.statements_begin + 1);
    add_text(made, first, at);
    return made;
  }

  bool shows(const LaidLine& line) const {
    for (auto i = line.statements_begin; i < line.statements_end; ++i)
      if (!shown_[i] || !is_handy(statement(i)))
        return false;
    return true;
  }

  /// The line after the end of the statements that begin on line `first`.
  std::size_t end_of_statements(std::size_t first) const {
    const auto end = statement(lines_[first].statements_end - 1).span.end;
    auto at = first + 1;
    while (at < lines_.size() && lines_[at].source.begin < end)
      ++at;
    return at;
  }

  /// The same for text without a form; comments below it on lines of their own are separate.
  std::size_t end_of_text(std::size_t first) const {
    auto end = first + 1;
    for (auto at = end;
         at < lines_.size() && lines_[at].statements_begin == lines_[at].statements_end; ++at)
      if (lines_[at].code > 0)
        end = at + 1;
    return end;
  }

  Json comment_row(const LaidLine& line) const {
    Json made{{"kind", "comment"},
              {"line", source_.position(line.source.begin).line},
              {"text", line.text}};
    if (line.after_blank)
      made["after_blank"] = true;
    if (line.level != line.around)
      made["indent"] = static_cast<int>(line.level) - static_cast<int>(line.around);
    return made;
  }

  Json place(std::size_t first, std::size_t end) const {
    Json made{{"kind", nullptr}, {"line", source_.position(lines_[first].source.begin).line}};
    const auto last = source_.position(lines_[end - 1].source.begin).line;
    if (last != made["line"])
      made["last"] = last;
    if (lines_[first].after_blank)
      made["after_blank"] = true;
    return made;
  }

  void add_text(Json& made, std::size_t first, std::size_t end) const {
    std::string text;
    auto lines = Json::array();
    for (auto at = first; at < end; ++at) {
      const auto code = std::string_view(lines_[at].text).substr(0, lines_[at].code);
      text += (text.empty() || code.empty() ? "" : " ") + std::string(code);
      lines.push_back(at + 1 < end ? std::string_view(lines_[at].text) : code);
    }
    made["text"] = text;
    if (end - first > 1) {
      made["lines"] = std::move(lines);
      made["indent"] =
          static_cast<int>(lines_[first + 1].level) - static_cast<int>(lines_[first].level);
    }
    const auto& last = lines_[end - 1];
    if (last.code < last.text.size())
      made["comment"] = trim(std::string_view(last.text).substr(last.code));
  }

  void add_branches(Json& made, std::uint32_t i) const {
    describe(made["then"], i++);
    if (statement(i).kind == Kind::Else)
      describe(made["else"], i + 1);
  }

  void describe(Json& made, std::uint32_t i) const {
    const auto& one = statement(i);
    made["kind"] = name_of(one.kind);
    if (!one.one_line && (opens_block(one.kind) || one.opener != none))
      made["block"] = one.opener == none ? "open" : one.next == none ? "end" : "part";
    if (one.kind == Kind::Robot)
      made["word"] = spec::info(one.robot).word;
    if (one.name != none)
      made["name"] = program_.name(one.name);
    if (one.kind == Kind::Assign)
      made["sign"] = one.operation == Statement::none_operation
                         ? std::string("=")
                         : spec::operators[one.operation].symbol + std::string("=");
    const auto items = program_.items_of(one);
    if (items.empty())
      return;
    auto& all = made["items"] = Json::array();
    for (const auto& item : items) {
      Json part{{"kind", name_of(item.kind)}};
      if (has_node(item))
        part["value"] = expression(item.value);
      else if (item.kind == ItemKind::Name)
        part["text"] = program_.name(item.value);
      else if (item.kind == ItemKind::String || item.kind == ItemKind::Colour ||
               item.kind == ItemKind::Restart)
        part["text"] = first_spelling(program_, program_.text_of(item.span));
      all.push_back(std::move(part));
    }
  }

  // ---- expressions

  /// A node followed by its operands.
  Json expression(std::uint32_t root) const {
    const auto& node = program_.nodes[root];
    const auto operands = operands_of(root);
    Json made{{"kind", nullptr}};
    const auto name = [&](std::string_view kind, std::string_view text) {
      made["kind"] = kind;
      made["text"] = text;
    };
    switch (node.kind) {
    case NodeKind::Number:
    case NodeKind::Duration: name("number", program_.text_of(node.span)); break;
    case NodeKind::Name: name("name", program_.name(static_cast<std::uint32_t>(node.value))); break;
    case NodeKind::System: name("sensor", documented(program_.text_of(node.span))); break;
    case NodeKind::Element:
      name("element", program_.name(static_cast<std::uint32_t>(node.value)));
      break;
    case NodeKind::Call: name("call", program_.name(static_cast<std::uint32_t>(node.value))); break;
    case NodeKind::Builtin: name("builtin", spec::functions[node.what].word); break;
    case NodeKind::Least: name("builtin", spelling_of(Keyword::Min)); break;
    case NodeKind::Greatest: name("builtin", spelling_of(Keyword::Max)); break;
    case NodeKind::Negate: name("negate", "-"); break;
    case NodeKind::Binary: {
      const char sign = spec::operators[node.what].symbol;
      name("operation", {&sign, 1});
      break;
    }
    case NodeKind::Relation: name("relation", sign_of(operands)); break;
    case NodeKind::Not: name("not", spelling_of(Keyword::Not)); break;
    case NodeKind::And: name("logic", spelling_of(Keyword::And)); break;
    case NodeKind::Or: name("logic", spelling_of(Keyword::Or)); break;
    }
    if (measures_[root].groups > 0)
      made["groups"] = measures_[root].groups;
    if (!operands.empty()) {
      auto& all = made["operands"] = Json::array();
      for (const auto operand : operands)
        all.push_back(expression(operand));
    }
    return made;
  }

  static std::string_view spelling_of(Keyword keyword) {
    return keyword_words[static_cast<std::size_t>(keyword)];
  }

  /// A program may write `<>` or `!=`.
  std::string_view sign_of(const std::vector<std::uint32_t>& operands) const {
    const auto between = program_.text_of(
        {measures_[operands.front()].outside.end, measures_[operands.back()].outside.begin});
    const auto at = between.find_first_of("=<>!");
    const auto size = std::min(between.find_first_not_of("=<>!", at), between.size()) - at;
    return between.substr(at, size);
  }

  /// The span of a node including parentheses, their number, and the depth of its operands.
  struct Measure {
    Span outside;
    std::uint8_t groups = 0;
    std::uint8_t depth = 1;
  };

  Source source_;
  Program program_;
  std::vector<LaidLine> lines_;
  std::vector<bool> shown_;       ///< by statement
  std::vector<Measure> measures_; ///< by node
};

} // namespace

std::string structured_tree(std::string_view text) {
  return Tree(text).print();
}

std::string structured_vocabulary() {
  auto statements = Json::array();
  for (const auto& row : spec::statements) {
    auto parameters = Json::array();
    for (const auto& parameter : row.parameters())
      parameters.push_back(Json{{"name", parameter.name},
                                {"least", parameter.least},
                                {"greatest", parameter.greatest},
                                {"unit", parameter.unit}});
    const auto wider = std::find_if(wider_words.begin(), wider_words.end(),
                                    [&](const WordInfo& info) { return info.word == row.word; });
    statements.push_back({{"word", row.word},
                          {"form", name_of(row.form)},
                          {"required", row.required},
                          {"summary", wider == wider_words.end() ? row.summary : wider->summary},
                          {"parameters", std::move(parameters)}});
  }
  auto sensors = Json::array();
  for (const auto& row : spec::variables)
    sensors.push_back({{"word", row.word},
                       {"settable", row.access == spec::Access::ReadWrite},
                       {"least", row.least},
                       {"greatest", row.greatest},
                       {"unit", row.unit},
                       {"summary", row.summary}});
  auto functions = Json::array();
  for (const auto& row : spec::functions)
    functions.push_back({{"word", row.word}, {"summary", row.summary}});
  auto operators = Json::array();
  for (const auto& row : spec::operators)
    operators.push_back({{"sign", std::string(1, row.symbol)}, {"summary", row.summary}});
  auto keywords = Json::array();
  for (const auto& row : structured::keywords)
    keywords.push_back({{"word", row.word}, {"summary", row.summary}});
  auto colours = Json::array();
  for (const auto name : colour_names())
    colours.push_back({{"name", name}, {"rgb", *find_colour(name)}});
  auto lamps = Json::array();
  for (const auto& row : spec::led_colours)
    lamps.push_back(row.name);
  return Json({{"statements", std::move(statements)},
               {"sensors", std::move(sensors)},
               {"functions", std::move(functions)},
               {"operators", std::move(operators)},
               {"keywords", std::move(keywords)},
               {"colours", std::move(colours)},
               {"led_colours", std::move(lamps)},
               {"longest_name", longest_name}})
      .dump();
}

} // namespace orb::editor
