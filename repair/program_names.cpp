#include "repair/program_names.h"

#include "base/fixes.h"
#include "base/text/text.h"
#include "repair/line.h"
#include "repair/scenery.h"
#include "repair/texts.h"
#include "spec/basic.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace orb::repair {
namespace {

struct Program {
  Program(std::string_view text, const Dialect& its_judge)
      : source({}, std::string(text)), dialect(its_judge), scenery(source, Language::Basic) {
    for (std::uint32_t n = 1; n <= source.line_count(); ++n)
      lines.push_back(split(source.line(n).substr(0, longest_line), Language::Basic));
  }
  const Tokens& tokens(std::uint32_t line) const { return lines[line - 1].tokens; }
  Span span(std::uint32_t line, const Token& first, const Token& last) const {
    const auto begin = source.line_start(line);
    return {begin + first.at, begin + last.at + static_cast<std::uint32_t>(last.text.size())};
  }

  Source source;
  const Dialect& dialect;
  Scenery scenery;
  std::vector<SplitLine> lines; ///< line 1 first
};

/// A change of the whole program, reported on one of its lines.
struct Proposal {
  std::uint32_t line = 0;
  Fix fix;
  Message help = {};    ///< empty: the resulting line
  Message message = {}; ///< empty: keep the finding's message
  Span span = {};       ///< of the message
  bool last = false;    ///< only if nothing else is proposed: it may also be a misspelt word
};
using Proposals = std::vector<Proposal>;

// ---- multi-letter names

/// Where a line assigns a name, and where its declaration begins.
struct Assigned {
  std::size_t begin;
  std::size_t name;
};

/// Finds names before `=`, after `for`, `read` and `input`.
std::vector<Assigned> places_set(const Tokens& line) {
  constexpr std::string_view declaring = "int var long byte float double integer number auto "
                                         "static global const final dim set let";
  std::vector<Assigned> found;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool begins = i == 0 || line[i - 1].is("then") || line[i - 1].is("else");
    const bool declared =
        begins && i + 1 < line.size() && line[i + 1].is_word() && holds(declaring, line[i].text);
    const Assigned place{i, declared ? i + 1 : i};
    const bool taken = (i == 1 && holds("for read input", line[0].text)) ||
                       (i > 1 && line[0].is("read") && line[i - 1].is(","));
    const auto value = place.name + 2;
    const bool assigned = begins && value < line.size() && line[value - 1].is("=") &&
                          !line[value].is_text() && !has_token(line, ",");
    if (line[place.name].is_word() && !holds(declaring, line[place.name].text) &&
        (taken || assigned))
      found.push_back(place);
  }
  return found;
}

/// True if a word of a line is a variable: not a word of the language nor a timer without its
/// letter, unless a line counts with it. A sensor that other lines read may be one.
bool is_name(const Program& program, std::string_view word, std::uint32_t line) {
  const auto stands = [&](std::size_t times, std::uint32_t but) {
    for (std::uint32_t n = 1; n <= program.lines.size(); ++n)
      if (n != but &&
          static_cast<std::size_t>(std::count_if(
              program.tokens(n).begin(), program.tokens(n).end(), [&](const Token& token) {
                return token.is_word() && equal_words(token.text, word);
              })) >= times)
        return true;
    return false;
  };
  if (word.size() < 2)
    return false;
  for (const auto& row : spec::variables)
    if (row.access == spec::Access::ReadWrite &&
        equal_words(row.word.substr(0, row.word.size() - 1), word))
      return stands(2, 0);
  const auto sensor = spec::find_variable(word);
  return sensor ? spec::info(*sensor).access == spec::Access::Read &&
                      !holds("yaw xpos ypos", word) && stands(1, line)
                : !has_word(program.dialect.words, word);
}

/// The first letter of a name if it is free, else another free one; never Y or Z.
char take_letter(std::set<char>& used, std::string_view name) {
  for (const char c : std::string(1, to_upper(name[0])) + "ABCDEFGHIJKLMNOPQRSTUVWX")
    if (c >= 'A' && c < 'Y' && used.insert(c).second)
      return c;
  return '\0';
}

/// Proposes a free letter for each name, at the first line that assigns it.
Proposals letters_for_names(const Program& program) {
  std::set<char> used;
  for (const auto& line : program.lines)
    for (const auto& token : line.tokens)
      if (token.is_word() && token.text.size() == 1)
        used.insert(to_upper(token.text[0]));
  Proposals all;
  std::map<std::string, std::pair<std::size_t, char>> names;
  for (std::uint32_t n = 1; n <= program.lines.size(); ++n)
    for (const auto& place : places_set(program.tokens(n))) {
      const auto& word = program.tokens(n)[place.name].text;
      if (names.contains(lower(word)) || program.scenery.number(n).empty() ||
          !is_name(program, word, n))
        continue;
      const auto letter = take_letter(used, word);
      if (letter == '\0')
        return {};
      names.emplace(lower(word), std::pair(all.size(), letter));
      const bool sensor = spec::find_variable(word).has_value();
      all.push_back(
          {n, {texts::CallItEverywhere(letter), {}, sensor ? Safety::Unsafe : Safety::Safe}});
    }
  for (std::uint32_t n = 1; !all.empty() && n <= program.lines.size(); ++n) {
    const auto& tokens = program.tokens(n);
    const auto set = places_set(tokens);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      const auto name = tokens[i].is_word() ? names.find(lower(tokens[i].text)) : names.end();
      if (name == names.end())
        continue;
      const auto [made, letter] = name->second;
      const auto place =
          std::find_if(set.begin(), set.end(), [i](const Assigned& one) { return one.name == i; });
      const auto& first = place == set.end() ? tokens[i] : tokens[place->begin];
      all[made].fix.edits.push_back({program.span(n, first, tokens[i]), std::string(1, letter)});
    }
  }
  for (auto& one : all)
    one.last = one.fix.edits.size() == 1;
  return all;
}

// ---- labels

/// An operand of `goto` or `gosub` that is not a number.
struct NamedJump {
  std::uint32_t line;
  const Token* name;
  bool calls;
};
std::vector<NamedJump> named_jumps(const Program& program) {
  std::vector<NamedJump> found;
  for (std::uint32_t n = 1; n <= program.lines.size(); ++n) {
    bool jumps = false;
    bool calls = false;
    for (const auto& token : program.tokens(n)) {
      const bool begins = holds("goto gosub", token.text) && token.is_word();
      calls = begins ? equal_words(token.text, "gosub") : calls;
      jumps = begins || (jumps && (token.is(",") || token.is_number() || token.is_word()));
      if (jumps && !begins && token.is_word() && token.text.size() > 1 && !token.is("else"))
        found.push_back({n, &token, calls});
    }
  }
  return found;
}

/// Replaces labels by line numbers; a label without a jump becomes a comment.
Proposals numbers_for_labels(const Program& program) {
  Proposals all;
  const auto jumps = named_jumps(program);
  for (std::uint32_t n = 1; n <= program.lines.size(); ++n) {
    const auto& tokens = program.tokens(n);
    const auto own = program.scenery.number(n);
    if (tokens.size() < 2 || !tokens[0].is_word() || !tokens[1].is(":") ||
        holds("else then repeat forever loop do default begin try", tokens[0].text) ||
        has_word(program.dialect.words, tokens[0].text))
      continue;
    const bool alone = tokens.size() == 2;
    const auto below = alone ? program.scenery.number_below(n) : own;
    const auto target = below.empty() ? own : below;
    Proposal made{n, {}};
    for (const auto& jump : jumps)
      if (equal_words(jump.name->text, tokens[0].text) && jump.line != n && !target.empty())
        made.fix.edits.push_back({program.span(jump.line, *jump.name, *jump.name), target});
    const bool named = !made.fix.edits.empty();
    made.last = !named &&
                (!alone || std::any_of(program.dialect.words.begin(), program.dialect.words.end(),
                                       [&](std::string_view word) {
                                         return equal_words(word, tokens[0].text.substr(
                                                                      0, word.size())); // `NEXTI:`
                                       }));
    if (!named && own.empty())
      continue; // it needs a number first
    const auto label = program.span(n, tokens[0], tokens[1]);
    made.message = texts::NoLabels(program.source.text(label));
    made.span = label;
    if (!alone) {
      const auto rest = program.source.line_start(n) + tokens[2].at;
      made.fix.edits.push_back({{label.begin, rest}, ""});
      made.help = named ? texts::RemoveLabelAndJump(target) : texts::RemoveLabel();
    } else if (!named) {
      made.fix.edits.push_back({{label.begin, label.begin}, "' "});
      made.help = texts::MakeItComment();
    } else if (!below.empty()) {
      made.fix.edits.push_back({{program.source.line_start(n), label.end}, ""});
      made.help = texts::RemoveLineAndJump(target);
    } else { // a jump to it ends the program
      made.fix.edits.push_back({label, "end"});
    }
    std::sort(made.fix.edits.begin(), made.fix.edits.end(),
              [](const Edit& a, const Edit& b) { return a.span.begin < b.span.begin; });
    made.fix.title = made.help.empty() ? texts::Write(own + " end") : made.help;
    all.push_back(std::move(made));
  }
  return all;
}

/// The number of the only uncalled subroutine: it follows a line that does not fall through, and
/// ends with `return`. Empty unless there is exactly one.
std::string only_subroutine(const Program& program) {
  std::string only;
  std::string begin; // of a possible subroutine
  bool falls = true;
  for (std::uint32_t n = 1; n <= program.lines.size(); ++n) {
    const auto& tokens = program.tokens(n);
    if (tokens.empty())
      continue;
    begin = falls ? begin : program.scenery.number(n);
    falls = !holds("end return goto", tokens[0].text);
    if (!tokens[0].is("return") || begin.empty() || !program.scenery.jumps_to(begin).empty())
      continue;
    if (!only.empty())
      return {};
    only = begin;
  }
  return only;
}

/// Resolves jumps to the text of a comment, and `gosub flash` if there is only one possible target.
Proposals numbers_for_jumps(const Program& program, const Proposals& labels) {
  Proposals all;
  const auto only = only_subroutine(program);
  std::map<std::string, std::string> numbers;
  for (const auto& jump : named_jumps(program)) {
    const auto span = program.span(jump.line, *jump.name, *jump.name);
    const auto known = numbers.try_emplace(jump.name->text);
    if (known.second)
      known.first->second = program.scenery.number_of(jump.name->text);
    const auto& own = known.first->second;
    const auto& to = own.empty() && jump.calls ? only : own;
    const bool done = std::any_of(labels.begin(), labels.end(), [&](const Proposal& label) {
      return std::any_of(label.fix.edits.begin(), label.fix.edits.end(),
                         [&](const Edit& edit) { return edit.span == span; });
    });
    if (!done && !to.empty())
      all.push_back({jump.line, {{}, {{span, to}}, own.empty() ? Safety::Unsafe : Safety::Safe}});
  }
  return all;
}

// ---- several lines in one

/// Splits `10 LEDC 1 20 LEDC 2` into lines, each but the last with its line ending; empty if it is
/// one line.
std::string lines_in_one(const Program& program, std::uint32_t line) {
  const auto text = program.source.line(line);
  const auto below = parse_number<std::uint32_t>(program.scenery.number_below(line));
  auto number = parse_number<std::uint32_t>(program.scenery.number(line)).value_or(0);
  const auto is_line = [&](std::string_view part) {
    return part.find(' ') != std::string_view::npos && program.dialect.parses(part);
  };
  std::string lines;
  std::size_t from = 0;
  for (const auto& token : program.tokens(line)) {
    const auto next = parse_number<std::uint32_t>(token.text).value_or(0);
    const auto part = trim(text.substr(from, token.at - from));
    if (number == 0 || next <= number || next >= below.value_or(greatest_line_number) ||
        !is_line(part))
      continue;
    lines += std::string(part) + std::string(line_end_of(program.source.text()));
    from = token.at;
    number = next;
  }
  const auto rest = trim(text.substr(from));
  return lines.empty() || !is_line(rest) ? std::string() : lines + std::string(rest);
}

// ---- applying the proposals

/// Translates a fix to a text with the same number of lines; nothing if it touches a line that
/// differs.
std::optional<Fix> moved(Fix fix, const Source& from, const Source& to) {
  for (auto& edit : fix.edits) {
    const auto first = from.position(edit.span.begin).line;
    const auto last = from.position(edit.span.end).line;
    for (auto n = first; n <= last; ++n)
      if (from.line(n) != to.line(n))
        return std::nullopt;
    edit.span = {to.line_start(first) + edit.span.begin - from.line_start(first),
                 to.line_start(last) + edit.span.end - from.line_start(last)};
  }
  return fix;
}

/// Splits `10 LEDC 1 : delay 500` in the same way; each statement gets a number that no jump uses.
std::string statements_in_one(const Program& program, std::uint32_t line) {
  const auto text = program.source.line(line);
  const auto& tokens = program.tokens(line);
  const auto number = parse_number<std::uint32_t>(program.scenery.number(line)).value_or(0);
  const auto below = parse_number<std::uint32_t>(program.scenery.number_below(line))
                         .value_or(greatest_line_number);
  const auto count = static_cast<std::uint32_t>(std::count_if(
                         tokens.begin(), tokens.end(), [](const Token& t) { return t.is(":"); })) +
                     1;
  const auto step = below > number ? std::min((below - number) / count, std::uint32_t{10}) : 0;
  if (number == 0 || count == 1 || step == 0 || holds("if", tokens[0].text) ||
      text.size() > longest_line)
    return {};
  std::string lines;
  auto next = number;
  std::size_t from = tokens[0].at;
  for (std::size_t i = 1; i <= tokens.size(); ++i) {
    if (i < tokens.size() && !tokens[i].is(":"))
      continue;
    const auto end = i < tokens.size() ? tokens[i].at : text.size(); // including the comment
    const auto statement = trim(text.substr(from, end - from));
    if (statement.empty() && i == tokens.size())
      break; // `next L:`
    const auto one = fmt::format("{} {}", next, statement);
    if (!program.dialect.parses(one) ||
        (next != number && !program.scenery.jumps_to(std::to_string(next)).empty()))
      return {};
    lines += (lines.empty() ? "" : line_end_of(program.source.text()));
    lines += one;
    next += step;
    from = end + 1;
  }
  return lines;
}

/// Splits lines with several statements.
void part_lines(const Program& program, std::vector<Diagnostic>& findings) {
  for (auto& finding : findings) {
    const auto line = program.source.position(finding.span.begin).line;
    auto lines = is_error(finding) ? lines_in_one(program, line) : std::string();
    if (lines.empty() && is_error(finding))
      lines = statements_in_one(program, line);
    if (lines.empty())
      continue;
    finding.help = {};
    for (std::size_t at = 0; at < lines.size();) {
      const auto end = std::min(lines.find_first_of("\r\n", at), lines.size());
      const auto one = lines.substr(at, end - at);
      finding.help = at == 0 ? texts::Write(one) : texts::Then(finding.help, one);
      at = std::min(lines.find_first_not_of("\r\n", end), lines.size());
    }
    finding.fix = Fix{finding.help, {{program.source.line_span(line), lines}}, Safety::Safe};
  }
}

/// The line of an error; 0 if the error is in its number.
std::uint32_t line_of(const Program& program, const Diagnostic& finding) {
  const auto [line, column] = program.source.position(finding.span.begin);
  return is_error(finding) && column > program.lines[line - 1].head.size() ? line : 0;
}

/// Adds a proposal to a finding: its line becomes `line`, with the change at `place`.
void tell(Diagnostic& finding, const Proposal& made, std::string_view line, const Edit& place,
          const Source& source) {
  const bool names = made.fix.title.is(texts::CallItEverywhere);
  const auto shown = trim(line);
  if (names && made.fix.safety == Safety::Unsafe) {
    finding.help = texts::WriteAndElsewhere(shown, place.text);
  } else if (names) {
    finding.message = texts::NotAVariable(source.text(place.span));
    finding.span = place.span;
    finding.help = texts::WriteBecause(shown, texts::VariablesAreNamed());
  } else {
    finding.help = made.help.empty() ? texts::Write(shown) : made.help;
    if (!made.message.empty()) {
      finding.message = made.message;
      finding.span = made.span;
    }
  }
  finding.fix = made.fix;
  if (finding.fix->title.empty())
    finding.fix->title = finding.help;
}

/// Copies findings about the changed program to the findings of the original.
void take_over(const Program& program, const Proposals& all, const Program& then,
               const std::vector<Diagnostic>& after, std::vector<Diagnostic>& findings) {
  std::set<std::uint32_t> told{0};
  for (auto& finding : findings) {
    const auto n = line_of(program, finding);
    if (!told.insert(n).second)
      continue;
    const auto span = program.source.line_span(n);
    const auto other = std::find_if(after.begin(), after.end(),
                                    [&](const Diagnostic& one) { return line_of(then, one) == n; });
    if (program.source.line(n) == then.source.line(n)) {
      if (other != after.end()) {
        finding.help = other->help;
        finding.fix = other->fix ? moved(*other->fix, then.source, program.source) : std::nullopt;
      }
      continue;
    }
    for (const auto& one : all) {
      const auto edit =
          std::find_if(one.fix.edits.begin(), one.fix.edits.end(), [&](const Edit& e) {
            return e.span.begin >= span.begin && e.span.end <= span.end;
          });
      if (edit == one.fix.edits.end())
        continue;
      if (one.message.empty() || one.line == n)
        tell(finding, one, then.lines[n - 1].head + join(then.lines[n - 1].tokens), *edit,
             program.source);
      else
        finding.help = texts::Write(trim(then.lines[n - 1].head + join(then.lines[n - 1].tokens)));
      if (one.line != n)
        finding.fix.reset();
      break;
    }
    if (other != after.end() && !other->help.empty())
      finding.help = other->help;
    for (std::size_t i = 0; finding.fix && i < finding.fix->edits.size(); ++i)
      if (auto& edit = finding.fix->edits[i]; edit.text.empty() && edit.span == span)
        edit.span.end = program.source.line_start(n + 1); // remove an empty line completely
  }
}

} // namespace

void offer_program(std::string_view text, const Dialect& dialect,
                   std::vector<Diagnostic>& findings) {
  const Program program(text, dialect);
  auto all = letters_for_names(program);
  const auto labels = numbers_for_labels(program);
  const auto jumps = numbers_for_jumps(program, labels);
  all.insert(all.end(), labels.begin(), labels.end());
  all.insert(all.end(), jumps.begin(), jumps.end());
  const auto few =
      std::stable_partition(all.begin(), all.end(), [](const Proposal& one) { return !one.last; });
  std::vector<Diagnostic> taken;
  for (auto one = all.begin(); one != few; ++one) {
    taken.emplace_back().fix = one->fix;
    taken.back().fix->safety = Safety::Safe;
  }
  const Program then(apply_fixes(text, taken).text, dialect);
  auto after = taken.empty() ? findings : dialect.check(then.source.text());
  part_lines(then, after);
  offer_lines(then.source.text(), dialect, after);
  if (taken.empty())
    findings = std::move(after);
  else
    take_over(program, {all.begin(), few}, then, after, findings);
  for (auto& finding : findings) {
    const auto n = line_of(program, finding);
    const auto own =
        std::find_if(few, all.end(), [n](const Proposal& one) { return one.line == n; });
    if (n == 0 || own == all.end() || finding.fix)
      continue;
    const auto& edit = own->fix.edits.front();
    auto line = std::string(program.source.line(n));
    line.replace(edit.span.begin - program.source.line_start(n), edit.span.size(), edit.text);
    if (dialect.parses(line))
      tell(finding, *own, line, edit, program.source);
  }
}

} // namespace orb::repair
