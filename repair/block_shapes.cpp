#include "repair/block_shapes.h"

#include "base/text/text.h"
#include "repair/block_line.h"
#include "repair/fill.h"
#include "repair/repair.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <iterator>
#include <optional>
#include <set>
#include <unordered_set>
#include <utility>

namespace orb::repair {
namespace {

constexpr std::size_t most_foreign = 64; // limit on lines that do not parse
constexpr std::size_t block_states = 40; // of one line
constexpr char place_sign = '\x1a';      // never typed by a user

Tokens middle(const Tokens& tokens, std::size_t from, std::size_t cut = 0) {
  return {tokens.begin() + static_cast<std::ptrdiff_t>(from),
          tokens.end() - static_cast<std::ptrdiff_t>(cut)};
}

bool begins(const Tokens& tokens, std::string_view word) {
  return !tokens.empty() && tokens[0].is_word() && equal_words(tokens[0].text, word);
}

/// Sets the role of a line written as in a structured program; returns false for other lines.
bool take_role(BlockLine& line, const Tokens& tokens) {
  const auto text = join(tokens);
  for (const auto& one : block_words)
    if (equal_words(text, one.form)) {
      line.role = one.role;
      line.ends = one.ends;
      return true;
    }
  const auto size = tokens.size();
  const auto with = [&](Role role, Tokens operand) {
    for (std::size_t i = 1; i < operand.size(); ++i)
      if (operand[i - 1].is_number() && operand[i].is_word() &&
          !equal_words(operand[i].text, "to") && !equal_words(operand[i].text, "step") &&
          !equal_words(operand[i].text, "and") && !equal_words(operand[i].text, "or"))
        return false; // `3 times`
    const bool known = std::none_of(operand.begin(), operand.end(), [](const Token& token) {
      return token.is_text() || token.is("{") || token.is(":") || equal_words(token.text, "then") ||
             equal_words(token.text, "do");
    });
    if (operand.empty() || !known)
      return false;
    line.role = role;
    line.operand = std::move(operand);
    return true;
  };
  const bool then = size > 2 && equal_words(tokens.back().text, "then");
  if (then && begins(tokens, "if"))
    return with(Role::If, middle(tokens, 1, 1));
  if (then && begins(tokens, "elseif"))
    return with(Role::ElseIf, middle(tokens, 1, 1));
  if (begins(tokens, "while"))
    return with(Role::While, middle(tokens, 1));
  if (begins(tokens, "until"))
    return with(Role::Until, middle(tokens, 1));
  if (begins(tokens, "repeat"))
    return with(Role::Repeat, middle(tokens, 1));
  if (begins(tokens, "for") && size > 5 && tokens[2].is("="))
    return with(Role::For, middle(tokens, 1));
  return false;
}

class Blocks {
public:
  Blocks(const Source& source, const Scenery& scenery,
         const std::function<bool(std::string_view)>& parses)
      : source_(source), scenery_(scenery), parses_(parses) {}

  std::vector<BlockRewrite> all() {
    read();
    for (std::size_t i = 0; i < lines_.size(); ++i)
      place(i);
    if (!open_.empty() && !open_.back().by_indent && lines_.back().role == Role::Stop &&
        open_.back().begin + 1 < lines_.size())
      close_at(lines_.size() - 1);
    while (!open_.empty() && (open_.back().by_indent || goes_to_the_end(open_.back()))) {
      sure_ = open_.back().by_indent;
      close_above(lines_.size());
    }
    return std::move(found_);
  }

private:
  struct Open {
    std::size_t begin = 0; ///< the opening line
    Role role = Role::None;
    bool by_indent = false;
    std::vector<std::size_t> arms;  ///< `elseif` and `else`
    std::vector<std::size_t> exits; ///< and `continue`
    std::vector<std::size_t> inner; ///< lines of nested blocks
  };

  void read() {
    std::size_t foreign = 0;
    for (std::uint32_t n = 1; n <= source_.line_count(); ++n) {
      const auto text = source_.line(n);
      if (text.size() > longest_line)
        continue;
      const auto parts = split(text, Language::Basic);
      if (parts.tokens.empty())
        continue;
      BlockLine line;
      line.line = n;
      const auto digits = parts.head.find_first_of("0123456789");
      const auto number = parse_number<std::uint32_t>(
          digits == std::string::npos
              ? std::string_view()
              : std::string_view(parts.head)
                    .substr(digits, parts.head.find_first_not_of("0123456789", digits) - digits));
      if (!number || *number > greatest_line_number)
        continue; // it needs a number first
      line.number = *number;
      line.indent = parts.head.size() - parts.head.find_last_of("0123456789");
      line.comment = parts.comment;
      line.colon = parts.tokens.back().is(":");
      if (!parses_(text) && ++foreign <= most_foreign)
        read_role(line, parts.tokens);
      else if (parts.tokens.size() == 1 && parts.tokens[0].is("end"))
        line.role = Role::Stop;
      lines_.push_back(std::move(line));
    }
  }

  void read_role(BlockLine& line, const Tokens& tokens) const {
    auto bare = tokens;
    while (bare.size() > 1 && (bare.back().is(";") || bare.back().is(")")) && bare[0].is("}"))
      bare.pop_back();
    if (bare.size() == 1 && bare[0].is("}")) {
      line.role = Role::End;
      return;
    }
    if (begins(tokens, "loop") && tokens.size() == 1) { // of `do`, or `loop` itself
      line.role = Role::Loop;
      line.ends = "do";
      return;
    }
    if (take_role(line, tokens))
      return;
    Surroundings around;
    around.language = Language::Structured;
    std::unordered_set<std::string> seen;
    Rewrites rewrites;
    explore(join(tokens), around, {3, block_states}, seen, rewrites, [&](const Candidate& one) {
      return take_role(line, tokens_of(one.text, Language::Structured));
    });
    if (begins(tokens, "do") && (line.role == Role::Loop || line.role == Role::While))
      line.ends = "do";
  }

  // ---- matching lines to blocks

  /// True for an endless loop without an end that extends to the end of the program, because
  /// nothing there leaves it.
  bool goes_to_the_end(const Open& block) const {
    const auto leaves = [&](const BlockLine& line) {
      const auto tokens = split(source_.line(line.line), Language::Basic).tokens;
      return begins(tokens, "return") || begins(tokens, "end") || begins(tokens, "goto");
    };
    return block.role == Role::Loop && block.begin + 1 < lines_.size() &&
           std::none_of(lines_.begin() + static_cast<std::ptrdiff_t>(block.begin) + 1, lines_.end(),
                        leaves);
  }

  static bool fits(const Open& block, const BlockLine& end) {
    if (block.by_indent)
      return false;
    if (end.ends.empty())
      return true;
    constexpr std::pair<Role, std::string_view> pairs[] = {
        {Role::If, "if"},      {Role::While, "while"},   {Role::While, "do"},
        {Role::Loop, "loop"},  {Role::Loop, "do"},       {Role::Loop, "repeat"},
        {Role::Loop, "while"}, {Role::Repeat, "repeat"}, {Role::Repeat, "loop"}};
    return std::find(std::begin(pairs), std::end(pairs), std::pair(block.role, end.ends)) !=
           std::end(pairs);
  }

  void place(std::size_t i) {
    auto& line = lines_[i];
    const bool arm = line.role == Role::Else || line.role == Role::ElseIf;
    while (
        !open_.empty() && open_.back().by_indent &&
        line.indent <= lines_[open_.back().begin].indent &&
        !(arm && open_.back().role == Role::If && line.indent == lines_[open_.back().begin].indent))
      close_above(i);
    switch (line.role) {
    case Role::None:
    case Role::Stop: return;
    case Role::Loop:
      if (line.ends == "do" && !open_.empty() && lines_[open_.back().begin].ends == "do" &&
          fits(open_.back(), line))
        return close_at(i);
      [[fallthrough]];
    case Role::If:
    case Role::While:
    case Role::Repeat:
    case Role::For: return begin(i);
    case Role::Else:
    case Role::ElseIf:
      if (!open_.empty() && open_.back().role == Role::If)
        open_.back().arms.push_back(i);
      return;
    case Role::Exit:
    case Role::Continue:
      for (auto block = open_.rbegin(); block != open_.rend(); ++block)
        if (block->role != Role::If)
          return block->exits.push_back(i);
      return;
    case Role::Until:
      if (!open_.empty() && open_.back().role == Role::Loop)
        close_at(i);
      return;
    case Role::End:
      if (!open_.empty() && fits(open_.back(), line))
        close_at(i);
      return;
    }
  }

  void begin(std::size_t i) {
    Open block;
    block.begin = i;
    block.role = lines_[i].role;
    block.by_indent =
        lines_[i].colon && i + 1 < lines_.size() && lines_[i + 1].indent > lines_[i].indent;
    if (block.role == Role::For && !block.by_indent)
      return; // it ends with `next`, or another finding says more
    open_.push_back(std::move(block));
  }

  // ---- jumps; the place sign followed by 7 denotes the number of the first remaining line from
  // lines_[7] on

  static std::string at(std::size_t i) { return fmt::format("{}{}", place_sign, i); }

  /// A number between a line and the one below it.
  std::optional<std::uint32_t> between(std::size_t above) const {
    const auto from = lines_[above].number;
    const auto to = above + 1 < lines_.size() ? lines_[above + 1].number : from + 20;
    if (to <= from + 1 || to > greatest_line_number)
      return std::nullopt;
    return to > from + 5 ? from + 5 : from + 1;
  }

  void write(std::size_t i, std::string text) {
    lines_[i].text = std::move(text);
    lines_[i].changed = true;
  }
  /// Adds a statement below a line; returns false if no number is free.
  bool add_below(std::size_t i, const std::string& statement) {
    const auto number = between(i);
    if (!number || !lines_[i].below.empty())
      return false;
    lines_[i].below = fmt::format("{} {}", *number, statement);
    return true;
  }

  /// An `if` that jumps if the condition does not hold.
  static std::string unless(const Tokens& condition, std::size_t inside, std::size_t outside) {
    if (const auto other = opposite(condition, Language::Basic))
      return fmt::format("if {} then goto {}", *other, at(outside));
    return fmt::format("if {} then goto {} else goto {}", join(condition), at(inside), at(outside));
  }

  /// Closes the innermost block at line `i`, or above it if the indentation ends it.
  void close_at(std::size_t i) { close(i, i + 1); }
  void close_above(std::size_t i) { close(i, i); }
  void close(std::size_t i, std::size_t out) {
    const bool own_line = i < out;
    const auto block = std::move(open_.back());
    open_.pop_back();
    auto kept = lines_;
    if (block.role == Role::If && own_line)
      write(i, "");
    const bool made = block.role == Role::If ? arms(block, out) : loop(block, i, out, own_line);
    if (!made) {
      lines_ = std::move(kept);
      return;
    }
    auto changed = block.inner;
    changed.push_back(block.begin);
    for (const auto arm : block.arms) {
      changed.push_back(arm);
      changed.push_back(arm - 1); // it may have a `goto` below
    }
    changed.insert(changed.end(), block.exits.begin(), block.exits.end());
    changed.push_back(out - 1);
    if (!open_.empty()) {
      auto& inner = open_.back().inner;
      inner.insert(inner.end(), changed.begin(), changed.end());
    } else if (auto all = finished(std::move(changed))) {
      found_.push_back(std::move(*all));
    }
  }

  bool loop(const Open& block, std::size_t end, std::size_t out, bool own_line) {
    const auto operand = lines_[block.begin].operand;
    const auto close_with = [&](const std::string& statement) {
      if (!own_line)
        return add_below(out - 1, statement);
      write(end, statement);
      return true;
    };
    const auto leave = [&](std::size_t again) {
      for (const auto i : block.exits)
        write(i, "goto " + at(lines_[i].role == Role::Exit ? out : again));
      return true;
    };
    if (block.role == Role::While) {
      write(block.begin, unless(operand, block.begin + 1, out));
      return close_with("goto " + at(block.begin)) && leave(block.begin);
    }
    if (block.role == Role::Loop) {
      write(block.begin, "");
      const bool until = own_line && lines_[end].role == Role::Until;
      return close_with(until ? unless(lines_[end].operand, out, block.begin)
                              : "goto " + at(block.begin)) &&
             leave(block.begin);
    }
    if (!block.exits.empty())
      return false; // a jump out of a `for` leaves it open on the robot
    if (block.role == Role::For) {
      write(block.begin, "for " + join(operand));
      return close_with("next " + operand[0].text);
    }
    const auto letter = free_letter();
    write(block.begin, fmt::format("for {} = 1 to {}", letter, join(operand)));
    return !letter.empty() && close_with("next " + letter);
  }

  /// Writes the tests of an `if`, from the last to the first.
  bool arms(const Open& block, std::size_t out) {
    auto next = out; // target if the test of an arm fails
    for (auto i = block.arms.size(); i-- > 0;) {
      const auto arm = block.arms[i];
      if (lines_[arm].role == Role::Else) {
        if (i + 1 != block.arms.size())
          return false;
        write(arm, "goto " + at(out));
        next = arm + 1;
        continue;
      }
      if (!add_below(arm - 1, "goto " + at(out)))
        return false;
      write(arm, unless(lines_[arm].operand, arm + 1, next));
      next = arm;
    }
    write(block.begin, unless(lines_[block.begin].operand, block.begin + 1, next));
    return true;
  }

  std::string free_letter() {
    for (auto& letter : scenery_.free_letters())
      if (taken_.insert(letter).second)
        return letter;
    return {};
  }

  // ---- the text of the lines

  /// The text of a line in the robot's words; nothing if it has no equivalent.
  std::optional<std::string> in_basic(const std::string& text) const {
    if (text.empty() || parses_("1 " + text))
      return text;
    std::optional<std::string> known;
    Surroundings around;
    around.language = Language::Basic;
    std::unordered_set<std::string> seen;
    Rewrites rewrites;
    explore(text, around, {4, block_states}, seen, rewrites, [&](const Candidate& one) {
      if (parses_("1 " + one.text))
        known = one.text;
      return known.has_value();
    });
    return known;
  }

  /// Replaces places by line numbers; nothing if a line would have to be added but has no number,
  /// or if the source contains the sign.
  std::optional<std::string> resolved(const std::string& text) {
    std::string out;
    for (std::size_t from = 0;;) {
      const auto sign = text.find(place_sign, from);
      out += text.substr(from, sign - from);
      if (sign == std::string::npos)
        return out;
      from = std::min(text.find_first_not_of("0123456789", sign + 1), text.size());
      const auto number = parse_number<std::size_t>(text.substr(sign + 1, from - sign - 1));
      if (!number)
        return std::nullopt;
      auto i = *number;
      while (i < lines_.size() && lines_[i].gone())
        ++i;
      if (i == lines_.size() && !end_)
        end_ = end_of_program();
      if (i == lines_.size() && !end_)
        return std::nullopt;
      out += std::to_string(i == lines_.size() ? *end_ : lines_[i].number);
    }
  }

  /// The number of a line that only ends the program: the last one, if it is free for that.
  std::optional<std::uint32_t> end_of_program() {
    const auto last = lines_.size() - 1;
    if (lines_[last].gone()) {
      write(last, "end");
      return lines_[last].number;
    }
    const auto number = between(last);
    return number && add_below(last, "end") ? number : std::nullopt;
  }

  std::optional<BlockRewrite> finished(std::vector<std::size_t> changed) {
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    for (const auto i : changed) {
      auto text = resolved(lines_[i].text);
      auto below = resolved(lines_[i].below);
      if (!text || !below || !(text = in_basic(*text)))
        return std::nullopt;
      lines_[i].text = *text;
      lines_[i].below = *below;
    }
    BlockRewrite made;
    made.sure = sure_;
    for (const auto i : changed) {
      const auto& line = lines_[i];
      const auto span = source_.line_span(line.line);
      const auto text = line.gone() ? "" : fmt::format("{} {}", line.number, line.text);
      if (line.changed) {
        made.lines.emplace(line.line, text + (line.below.empty() ? "" : "\n" + line.below));
        const auto both = text + (text.empty() || line.comment.empty() ? "" : " ") + line.comment;
        made.edits.push_back(
            {both.empty() ? Span{span.begin, source_.line_start(line.line + 1)} : span, both});
      }
      if (!line.below.empty())
        made.edits.push_back(
            {{span.end, span.end}, std::string(line_end_of(source_.text())) + line.below});
    }
    return made;
  }

  const Source& source_;
  const Scenery& scenery_;
  const std::function<bool(std::string_view)>& parses_;
  std::vector<BlockLine> lines_;
  std::vector<Open> open_;
  std::vector<BlockRewrite> found_;
  std::set<std::string> taken_;      ///< variables of loops
  std::optional<std::uint32_t> end_; ///< the number of a line that only ends the program
  bool sure_ = true;
};

} // namespace

std::vector<BlockRewrite> blocks_as_jumps(const Source& source, const Scenery& scenery,
                                          const std::function<bool(std::string_view)>& parses) {
  return Blocks(source, scenery, parses).all();
}

} // namespace orb::repair
