#include "compiler/messages/names.h"

#include "base/text/text.h"
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
    auto d = finding(rules::Rem, fault_.span, texts::CommentsStartWith('\''),
                     texts::Write(parts.comment));
    d.fix = Fix{d.help, {{{begin(), line_.span.end}, parts.comment}}, Safety::Safe};
    return d;
  }

  /// `start:`, a label.
  std::optional<Diagnostic> label() const {
    const bool numbered = is(Reason::UnknownWord);
    const auto place = numbered ? Span{begin(), end()} : word_at(begin());
    if (!(numbered || is(Reason::MissingNumber)) || place.size() == 0 || after(place.end) != ':')
      return std::nullopt;
    const auto colon = skip_blanks(place.end);
    const auto name = program_.text_of(place);
    const bool alone = skip_blanks(colon + 1) >= code_end();
    if (!numbered && !alone)
      return std::nullopt;
    auto d = finding(rules::UnknownStatement, {place.begin, colon + 1},
                     texts::NoLabels(fmt::format("{}:", name)));
    auto jumps = edits_of_name(name, {});
    std::erase_if(jumps, [&](const Edit& one) {
      return one.span.begin == place.begin || !follows_jump(one.span.begin);
    });
    const auto below = alone ? number_below() : line_.number;
    if (!numbered && (below == 0 || jumps.empty()))
      return std::nullopt; // it takes a number first, whatever it is
    const auto number = below == 0 ? line_.number : below;
    if (jumps.empty()) {
      if (alone)
        offer(d, texts::MakeItComment(), {{{begin(), begin()}, "' "}});
      else
        offer(d, texts::RemoveLabel(), {{{begin(), skip_blanks(colon + 1)}, ""}});
      return d;
    }
    d.help = alone ? texts::RemoveLineAndJump(number) : texts::RemoveLabelAndJump(number);
    for (auto& jump : jumps)
      jump.text = std::to_string(number);
    if (below == 0) { // what jumps there ends
      d.help = texts::Write(fmt::format("{} end", number));
      jumps.push_back({{begin(), colon + 1}, "end"});
    } else {
      const Span line{line_.span.begin, next_line()};
      jumps.push_back({alone ? line : Span{begin(), skip_blanks(colon + 1)}, ""});
    }
    std::sort(jumps.begin(), jumps.end(),
              [](const Edit& a, const Edit& b) { return a.span.begin < b.span.begin; });
    d.fix = Fix{d.help, std::move(jumps), Safety::Safe};
    return d;
  }

  /// Whether a place is behind `goto` or `gosub`.
  bool follows_jump(std::uint32_t at) const {
    auto before = at;
    while (before > 0 && is_blank(text_[before - 1]))
      --before;
    const auto line = text_.substr(0, before);
    return line.ends_with("goto") || line.ends_with("gosub");
  }

  /// The number of the first statement below; 0 without one.
  std::uint32_t number_below() const {
    for (auto i = fault_.line + 1; i < program_.lines.size(); ++i) {
      const auto& line = program_.lines[i];
      auto at = line.number_span.end;
      while (at < line.span.end && is_blank(text_[at]))
        ++at;
      if (line.has_number() && at < line.span.end && text_[at] != '\'')
        return line.number;
    }
    return 0;
  }

  /// Where the line below begins.
  std::uint32_t next_line() const {
    return fault_.line + 1 < program_.lines.size() ? program_.lines[fault_.line + 1].span.begin
                                                   : static_cast<std::uint32_t>(text_.size());
  }

  /// A variable with a name of more than one letter: the first of a program gets a free letter.
  std::optional<Diagnostic> long_name() const {
    const auto span = set_name();
    if (!span)
      return std::nullopt;
    const auto name = program_.text_of(*span);
    const bool sensor = is(Reason::ReadOnly) && name == token();
    auto d = sensor ? finding(rules::AssignToSensor, *span, texts::CanOnlyBeRead(name))
                    : finding(is(Reason::ExpectedUserVariable) ? rules::SyntaxError
                                                               : rules::UnknownStatement,
                              *span, texts::NotAVariable(name), texts::VariablesAreNamed());
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
    d.help = texts::WriteBecause(line, texts::VariablesAreNamed());
    if (&fault_ != &first_name())
      return d;
    auto edits = edits_of_name(name, {&*letter, 1});
    if (sensor)
      d.help = texts::WriteAndElsewhere(line, *letter);
    if (declared)
      edits.insert(std::find_if(edits.begin(), edits.end(),
                                [&](const Edit& one) { return one.span.begin >= begin(); }),
                   {{begin(), span->begin}, ""});
    d.fix = Fix{texts::CallItEverywhere(*letter), std::move(edits),
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
      for (const auto& row : spec::statements)
        if (row.word != lower(row.word) && equal_words(row.word, name))
          return std::nullopt; // `rgb = 0,0,0`
      for (const auto& row : spec::variables)
        if (row.access == spec::Access::ReadWrite &&
            (equal_words(row.word, name) || (begins(row.word, name) && !counts(name))))
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

  /// Whether a name is a word of the robot without its last letter: `timer` of `timerA`.
  static bool begins(std::string_view word, std::string_view name) {
    return equal_words(word.substr(0, word.size() - 1), name);
  }

  /// Whether a line sets a name to what it was and more.
  bool counts(std::string_view name) const {
    return std::any_of(program_.lines.begin(), program_.lines.end(), [&](const Line& line) {
      std::vector<Edit> edits;
      add_edits(edits, line, name, {});
      return edits.size() > 1;
    });
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
    return finding(rules::SyntaxError, span, texts::NotAVariable(name),
                   texts::WriteBecause(with_letters(named), texts::VariablesAreNamed()));
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

  /// Where `:` stand between statements from `from` on: `print "a" : end`.
  std::vector<std::uint32_t> colons(std::uint32_t from) const {
    std::vector<std::uint32_t> found;
    const auto line = text_.substr(0, code_end());
    const auto brace =
        line.find_first_of("{?", line_.span.begin); // what follows is of other languages
    bool quoted = false;
    for (auto at = from; at < std::min(line.size(), brace); ++at) {
      quoted = quoted != (line[at] == '"');
      if (!quoted && line[at] == ':' && is_letter(after(at + 1)))
        found.push_back(at);
    }
    return found;
  }

  std::optional<Diagnostic> colon() const {
    const bool here = token() == ":" && (is(Reason::Trailing) || is(Reason::ExpectedStatement));
    const auto all = colons(skip_blanks(line_.number_span.end));
    if ((!here && all.empty()) || is(Reason::MissingNumber))
      return std::nullopt;
    const auto at = here ? begin() : all.front();
    auto d = finding(rules::Colon, {at, at + 1}, texts::OneStatementPerLine(':'),
                     texts::PutRestOnLine());
    if (!line_.has_number() || line_.number_span.size() == 0 || all.empty() || all.front() != at)
      return d;
    const auto first = skip_blanks(line_.number_span.end);
    std::vector<std::string> statements;
    for (auto from = first; const auto end : all) {
      statements.emplace_back(program_.text_of({from, skip_back(end)}));
      from = skip_blanks(end + 1);
    }
    statements.emplace_back(program_.text_of({skip_blanks(all.back() + 1), code_end()}));
    // After `then` the rest belongs to the branch, which holds one statement.
    if (program_.text_of(word_at(first)) == "if" && !repeat_condition(statements))
      return d;
    const auto step = step_below(statements.size());
    if (step == 0 || statements.front().size() < 2) // `A: int = 5`, `60: P = 1`
      return d;
    std::string lines;
    for (std::size_t i = 0; i < statements.size(); ++i) {
      const auto line =
          fmt::format("{} {}", line_.number + static_cast<std::uint32_t>(i) * step, statements[i]);
      d.help = i == 0 ? texts::Write(line) : texts::Then(d.help, line);
      lines += i == 0 ? "" : line_end_of(text_);
      lines += line;
    }
    d.fix = Fix{d.help, {{{line_.number_span.begin, code_end()}, lines}}, Safety::Safe};
    return d;
  }

  /// Puts the condition of the first statement before the others; false where that says something
  /// else: they set something, or asking twice is not asking once.
  static bool repeat_condition(std::vector<std::string>& statements) {
    const auto then = statements[0].find(" then ");
    if (then == std::string::npos)
      return false;
    const auto condition = statements[0].substr(0, then);
    const auto tokens = repair::tokens_of(condition, repair::Language::Basic);
    const bool plain = std::all_of(tokens.begin() + 1, tokens.end(), [](const auto& token) {
      return !token.is_word() || token.text.size() == 1 || token.is("and") || token.is("or");
    });
    for (std::size_t i = 0; i < statements.size(); ++i) {
      const auto branch = i == 0 ? statements[0].substr(then + 6) : statements[i];
      if (!plain || branch.find_first_of("=") != std::string::npos ||
          branch.find("else") != std::string::npos || branch.starts_with("if ") ||
          branch.starts_with("gosub") || branch.starts_with("input") || branch.starts_with("read"))
        return false;
      if (i > 0)
        statements[i] = fmt::format("{} then {}", condition, branch);
    }
    return true;
  }

  /// By how much the numbers of so many lines, this one among them, can grow without reaching the
  /// next one's or one that something jumps to; 0 where they cannot.
  std::uint32_t step_below(std::size_t lines) const {
    auto above = static_cast<std::uint32_t>(spec::value_of(spec::Limit::GreatestLineNumber)) + 1;
    for (auto i = fault_.line + 1; i < program_.lines.size(); ++i)
      if (program_.lines[i].has_number()) {
        above = program_.lines[i].number;
        break;
      }
    const auto count = static_cast<std::uint32_t>(lines);
    if (above <= line_.number)
      return 0;
    const auto step = std::min((above - line_.number) / count, std::uint32_t{10});
    const bool named =
        std::any_of(program_.items.begin(), program_.items.end(), [&](const Item& item) {
          return item.kind == ItemKind::Target && step > 0 && item.value > line_.number &&
                 (item.value - line_.number) % step == 0 &&
                 (item.value - line_.number) / step < count;
        });
    return named ? 0 : step;
  }
};

} // namespace

std::optional<Diagnostic> explain_name(const Program& program, const Fault& fault) {
  return Names(program, fault).explain();
}

} // namespace orb::compiler
