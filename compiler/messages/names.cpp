#include "compiler/messages/names.h"

#include "compiler/messages/fault_text.h"
#include "compiler/text/rules.h"
#include "repair/tokens.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::compiler {
namespace {

class Names : public FaultText {
public:
  using FaultText::FaultText;

  std::optional<Diagnostic> explain() const {
    if (auto d = label())
      return d;
    if (auto d = remark())
      return d;
    if (auto d = long_name())
      return d;
    if (auto d = used_name())
      return d;
    return colon();
  }

private:
  bool is(Reason reason) const { return fault_.reason == reason; }
  std::uint32_t begin() const { return fault_.span.begin; }
  std::uint32_t end() const { return fault_.span.end; }
  bool wordy() const { return !token().empty() && is_letter(token()[0]); }

  /// `# a remark` on a line of its own: comments need no number.
  std::optional<Diagnostic> remark() const {
    const auto line = program_.text_of(line_.span);
    if (!is(Reason::MissingNumber))
      return std::nullopt;
    const auto parts = repair::split(line, repair::Language::Basic);
    if (!parts.tokens.empty() || parts.comment.empty())
      return std::nullopt;
    auto d = finding(rules::Rem, fault_.span, "comments start with `'`",
                     fmt::format("write `{}`", parts.comment));
    d.fix = Fix{d.help, {{{begin(), line_.span.end}, parts.comment}}, Safety::Safe};
    return d;
  }

  /// `start:`, a label.
  std::optional<Diagnostic> label() const {
    if (!is(Reason::UnknownWord) || after(end()) != ':')
      return std::nullopt;
    const auto colon = skip_blanks(end());
    auto d = finding(rules::UnknownStatement, {begin(), colon + 1},
                     fmt::format("`{}:` is a label; orbBasic has no labels", token()),
                     fmt::format("jump to the line by its number: `goto {}`", line_.number));
    if (edits_of_name(token(), {}).size() > 1)
      return d; // the jumps to it come first
    if (skip_blanks(colon + 1) == code_end())
      offer(d, "make it a comment", {{{begin(), begin()}, "' "}});
    else
      offer(d, "remove the label", {{{begin(), skip_blanks(colon + 1)}, ""}});
    return d;
  }

  /// A variable with a name of more than one letter: the first of a program gets a free letter.
  std::optional<Diagnostic> long_name() const {
    const auto span = set_name();
    if (!span)
      return std::nullopt;
    const auto name = program_.text_of(*span);
    const bool sensor = is(Reason::ReadOnly) && name == token();
    auto d =
        sensor
            ? finding(rules::AssignToSensor, *span, fmt::format("`{}` can only be read", name), {})
            : finding(
                  is(Reason::ExpectedUserVariable) ? rules::SyntaxError : rules::UnknownStatement,
                  *span, fmt::format("`{}` is not a variable", name), "variables are named A to Z");
    const auto named = letters_of_names();
    const auto letter = letter_of(named, name);
    if (!letter)
      return d;
    auto line = with_letters(named);
    const bool declared = span->begin != begin() && is(Reason::UnknownWord);
    if (declared)
      line.erase(begin() - line_.span.begin, span->begin - begin());
    if (declared && !parse(line).faults.empty())
      return std::nullopt; // it takes more than a name
    d.help = fmt::format("write `{}`; variables are named A to Z", line);
    if (&fault_ != &first_name())
      return d;
    auto edits = edits_of_name(name, {&*letter, 1});
    if (sensor)
      d.help = fmt::format("write `{}`, and `{}` in the other lines; variables are named A to Z",
                           line, *letter);
    if (declared)
      edits.insert(std::find_if(edits.begin(), edits.end(),
                                [&](const Edit& one) { return one.span.begin >= begin(); }),
                   {{begin(), span->begin}, ""});
    d.fix = Fix{fmt::format("call it `{}` everywhere", *letter), std::move(edits),
                sensor ? Safety::Unsafe : Safety::Safe};
    return d;
  }

  static bool is_name_part(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

  /// Letters, digits and `_` that stand together around a place.
  Span name_around(std::uint32_t at) const {
    auto first = at;
    while (first > line_.span.begin && is_name_part(text_[first - 1]))
      --first;
    auto last = at;
    while (last < line_.span.end && is_name_part(text_[last]))
      ++last;
    while (first < last && !is_letter(text_[first]))
      ++first;
    return {first, last};
  }

  /// The name that the line sets and that is no variable: `count = 0`, `int led_2 = 5`, `for lap
  /// =`.
  std::optional<Span> set_name() const {
    constexpr std::string_view declare = " int var long byte float double integer number auto "
                                         "static global const final dim set ";
    auto span = name_around(begin());
    const bool declared = is(Reason::UnknownWord) && wordy() &&
                          declare.find(fmt::format(" {} ", token())) != std::string_view::npos &&
                          is_letter(after(span.end));
    if (declared)
      span = name_around(skip_blanks(span.end));
    const bool sets = (is(Reason::UnknownWord) || is(Reason::ReadOnly)) && after(span.end) == '=';
    if ((!sets && !(is(Reason::ExpectedUserVariable) && wordy())) || span.size() < 2)
      return std::nullopt;
    const auto name = program_.text_of(span);
    const auto word = find_word(name);
    if (word.kind == WordKind::Unknown) {
      for (const auto& row : spec::variables)
        if (row.access == spec::Access::ReadWrite && equal_words(row.word, name))
          return std::nullopt;
      return span;
    }
    // A sensor that other lines read, and nothing else sets it, was meant as a variable.
    const auto sensor = spec::find_variable(name);
    const bool plain = sensor && spec::info(*sensor).access == spec::Access::Read &&
                       *sensor != spec::Variable::Yaw && *sensor != spec::Variable::Xpos &&
                       *sensor != spec::Variable::Ypos;
    return plain && stands_elsewhere(name) ? std::optional(span) : std::nullopt;
  }

  bool stands_elsewhere(std::string_view name) const {
    return std::any_of(program_.lines.begin(), program_.lines.end(), [&](const Line& line) {
      std::vector<Edit> edits;
      if (&line != &line_)
        add_edits(edits, line, name, {});
      return !edits.empty();
    });
  }

  /// A name that is set on another line, where its value is wanted.
  std::optional<Diagnostic> used_name() const {
    const auto span = name_around(begin());
    const auto name = program_.text_of(span);
    if (name.empty() || find_word(name).kind != WordKind::Unknown)
      return std::nullopt;
    const auto named = letters_of_names();
    if (!letter_of(named, name))
      return std::nullopt;
    return finding(rules::SyntaxError, span, fmt::format("`{}` is not a variable", name),
                   fmt::format("write `{}`; variables are named A to Z", with_letters(named)));
  }

  using Named = std::vector<std::pair<std::string_view, char>>;

  static std::optional<char> letter_of(const Named& named, std::string_view name) {
    const auto found = std::find_if(named.begin(), named.end(),
                                    [&](const auto& one) { return equal_words(one.first, name); });
    return found == named.end() ? std::nullopt : std::optional(found->second);
  }

  /// The long names that the program sets, each with the letter that it gets.
  Named letters_of_names() const {
    constexpr std::size_t most = 64; // faults; nobody names more
    auto used = used_letters();
    Named named;
    std::size_t looked_at = 0;
    for (const auto& fault : program_.faults) {
      if (++looked_at > most)
        break;
      const Names other(program_, fault);
      const auto span = other.set_name();
      if (!span || letter_of(named, program_.text_of(*span)))
        continue;
      const auto letter = free_letter(used, program_.text_of(*span));
      if (!letter)
        break;
      used |= std::uint32_t{1} << (*letter - 'A');
      named.emplace_back(program_.text_of(*span), *letter);
    }
    return named;
  }

  /// The line with a letter for each long name.
  std::string with_letters(const Named& named) const {
    std::vector<Edit> edits;
    for (const auto& [name, letter] : named)
      add_edits(edits, line_, name, {&letter, 1});
    std::sort(edits.begin(), edits.end(),
              [](const Edit& a, const Edit& b) { return a.span.begin > b.span.begin; });
    const auto begin = line_.span.begin;
    std::string line(text_.substr(begin, code_end() - begin));
    for (const auto& edit : edits)
      line.replace(edit.span.begin - begin, edit.span.size(), edit.text);
    return line;
  }

  std::uint32_t used_letters() const {
    std::uint32_t used = 0;
    for (std::uint32_t i = 0; i < text_.size(); ++i)
      if (is_letter(text_[i]) && (i == 0 || !is_letter(text_[i - 1])) &&
          (i + 1 == text_.size() || !is_letter(text_[i + 1])))
        used |= std::uint32_t{1} << (to_lower(text_[i]) - 'a');
    return used;
  }

  /// The first letter of the name where nobody has it, else another free one; never Y and Z.
  static std::optional<char> free_letter(std::uint32_t used, std::string_view name) {
    const auto is_free = [&](char c) { return (used >> (c - 'A') & 1) == 0; };
    const char initial = to_upper(name[0]);
    if (initial < 'Y' && is_free(initial))
      return initial;
    for (char c = 'A'; c < 'Y'; ++c)
      if (is_free(c))
        return c;
    return std::nullopt;
  }

  /// The first fault that is such a name: two fixes of one round would take the same letter.
  const Fault& first_name() const {
    for (const auto& fault : program_.faults)
      if (&fault == &fault_ || Names(program_, fault).set_name())
        return fault;
    return fault_;
  }

  /// Every occurrence of a name as a word outside of strings and comments.
  std::vector<Edit> edits_of_name(std::string_view name, std::string_view letter) const {
    std::vector<Edit> edits;
    for (const auto& line : program_.lines)
      add_edits(edits, line, name, letter);
    return edits;
  }
  void add_edits(std::vector<Edit>& edits, const Line& line, std::string_view name,
                 std::string_view letter) const {
    const auto stop = line.comment.size() > 0 ? line.comment.begin : line.span.end;
    bool quoted = false;
    for (auto i = line.span.begin; i < stop; ++i) {
      quoted = quoted != (text_[i] == '"');
      if (quoted || !is_letter(text_[i]) ||
          (i > 0 && (is_letter(text_[i - 1]) || text_[i - 1] == '_')))
        continue;
      auto word_end = i;
      while (word_end < stop && is_name_part(text_[word_end]))
        ++word_end;
      if (equal_words(text_.substr(i, word_end - i), name))
        edits.push_back({{i, word_end}, std::string(letter)});
      i = word_end - 1;
    }
  }

  /// Where a `:` stands between two statements: `print "a" : end`.
  std::optional<std::uint32_t> colon_between() const {
    const auto line = text_.substr(0, code_end());
    bool quoted = false;
    for (auto at = skip_blanks(line_.number_span.end); at < line.size(); ++at) {
      quoted = quoted != (line[at] == '"');
      if (quoted || line[at] != ':')
        continue;
      const bool braces =
          line.substr(line_.span.begin, at - line_.span.begin).find('{') != std::string_view::npos;
      if (!braces && is_letter(after(at + 1)))
        return at;
    }
    return std::nullopt;
  }

  std::optional<Diagnostic> colon() const {
    const bool here = token() == ":" && (is(Reason::Trailing) || is(Reason::ExpectedStatement));
    const auto at = here ? std::optional(begin()) : colon_between();
    if (!at || is(Reason::MissingNumber))
      return std::nullopt;
    auto d = finding(rules::Colon, {*at, *at + 1},
                     "one statement per line; `:` does not separate statements",
                     "put the rest on a separate line");
    // After `then` the rest belongs to the branch, which holds one statement.
    const bool branch = program_.text_of(word_at(skip_blanks(line_.number_span.end))) == "if";
    if (!line_.has_number() || line_.number_span.size() == 0 || branch)
      return d;
    const auto number = free_number_below();
    const auto rest = skip_blanks(*at + 1);
    if (!number || rest == code_end())
      return d;
    d.help = fmt::format("put the rest on a separate line: `{} {}`", *number,
                         text_.substr(rest, code_end() - rest));
    d.fix = Fix{fmt::format("make it line {}", *number),
                {{{skip_back(*at), rest}, fmt::format("\n{} ", *number)}},
                Safety::Safe};
    return d;
  }

  /// A number between this line's and the next one's.
  std::optional<std::uint32_t> free_number_below() const {
    auto above = static_cast<std::uint32_t>(spec::value_of(spec::Limit::GreatestLineNumber)) + 1;
    for (auto i = fault_.line + 1; i < program_.lines.size(); ++i)
      if (program_.lines[i].has_number()) {
        above = program_.lines[i].number;
        break;
      }
    const auto number = above > line_.number + 10 ? line_.number + 5 : line_.number + 1;
    const bool named =
        std::any_of(program_.items.begin(), program_.items.end(), [&](const Item& item) {
          return item.kind == ItemKind::Target && item.value == number;
        });
    return number < above && !named ? std::optional(number) : std::nullopt;
  }
};

} // namespace

std::optional<Diagnostic> explain_name(const Program& program, const Fault& fault) {
  return Names(program, fault).explain();
}

} // namespace orb::compiler
