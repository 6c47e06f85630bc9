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
    if (edits_of_name({}).size() > 1)
      return d; // the jumps to it come first
    if (skip_blanks(colon + 1) == code_end())
      offer(d, "make it a comment", {{{begin(), begin()}, "' "}});
    else
      offer(d, "remove the label", {{{begin(), skip_blanks(colon + 1)}, ""}});
    return d;
  }

  /// A variable with a name of more than one letter: the first of a program gets a free letter.
  std::optional<Diagnostic> long_name() const {
    const bool set = is(Reason::UnknownWord) && after(end()) == '=';
    const bool counts = is(Reason::ExpectedUserVariable) && wordy();
    if ((!set && !counts) || find_word(token()).kind != WordKind::Unknown)
      return std::nullopt;
    for (const auto& row : spec::variables)
      if (row.access == spec::Access::ReadWrite && equal_words(row.word, token()))
        return std::nullopt;
    auto d = finding(set ? rules::UnknownStatement : rules::SyntaxError, fault_.span,
                     fmt::format("`{}` is not a variable", token()), "variables are named A to Z");
    const auto named = letters_of_names();
    const auto letter = letter_of(named, token());
    if (!letter)
      return d;
    d.help = fmt::format("write `{}`; variables are named A to Z", with_letters(named));
    if (&fault_ == &first_name())
      d.fix = Fix{fmt::format("call it `{}` everywhere", *letter), edits_of_name({&*letter, 1}),
                  Safety::Safe};
    return d;
  }

  /// A name that is set on another line, where its value is wanted.
  std::optional<Diagnostic> used_name() const {
    if ((!is(Reason::ExpectedExpression) && !is(Reason::Trailing)) || !wordy() ||
        find_word(token()).kind != WordKind::Unknown)
      return std::nullopt;
    const auto named = letters_of_names();
    if (!letter_of(named, token()))
      return std::nullopt;
    return finding(rules::SyntaxError, fault_.span, fmt::format("`{}` is not a variable", token()),
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
      if (!other.long_name_here() || find_word(other.token()).kind != WordKind::Unknown ||
          letter_of(named, other.token()))
        continue;
      const auto letter = free_letter(used, other.token());
      if (!letter)
        break;
      used |= std::uint32_t{1} << (*letter - 'A');
      named.emplace_back(other.token(), *letter);
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
      if (fault.reason == Reason::UnknownWord || fault.reason == Reason::ExpectedUserVariable)
        if (&fault == &fault_ || Names(program_, fault).long_name_here())
          return fault;
    return fault_;
  }
  bool long_name_here() const {
    return (is(Reason::UnknownWord) && after(end()) == '=') ||
           (is(Reason::ExpectedUserVariable) && wordy());
  }

  /// Every occurrence of the token as a word outside of strings and comments.
  std::vector<Edit> edits_of_name(std::string_view letter) const {
    std::vector<Edit> edits;
    for (const auto& line : program_.lines)
      add_edits(edits, line, token(), letter);
    return edits;
  }
  void add_edits(std::vector<Edit>& edits, const Line& line, std::string_view name,
                 std::string_view letter) const {
    const auto stop = line.comment.size() > 0 ? line.comment.begin : line.span.end;
    bool quoted = false;
    for (auto i = line.span.begin; i < stop; ++i) {
      quoted = quoted != (text_[i] == '"');
      if (quoted || !is_letter(text_[i]) || (i > 0 && is_letter(text_[i - 1])))
        continue;
      auto word_end = i;
      while (word_end < stop && is_letter(text_[word_end]))
        ++word_end;
      if (equal_words(text_.substr(i, word_end - i), name))
        edits.push_back({{i, word_end}, std::string(letter)});
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
