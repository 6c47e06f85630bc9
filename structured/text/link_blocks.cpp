#include "structured/text/link_blocks.h"

#include "base/fixes.h"
#include "base/text/text.h"
#include "structured/text/rules.h"
#include "structured/text/structured_words.h"
#include "structured/text/texts.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <set>

namespace orb::structured {
namespace {

constexpr std::size_t deepest = 64;

struct OpenBlock {
  Kind opener;
  Kind end;
  std::string_view word; ///< of the opener
  std::string_view end_words;

  /// The word after `end`; empty if the block ends in another way.
  constexpr std::string_view after_end() const {
    constexpr std::string_view end_word = "end ";
    return end_words.starts_with(end_word) ? end_words.substr(end_word.size()) : std::string_view();
  }
};

constexpr auto blocks = std::to_array<OpenBlock>({
    {Kind::If, Kind::EndIf, "if", "end if"},
    {Kind::While, Kind::EndWhile, "while", "end while"},
    {Kind::Repeat, Kind::Until, "repeat", "until"},
    {Kind::RepeatTimes, Kind::EndRepeat, "repeat", "end repeat"},
    {Kind::Loop, Kind::EndLoop, "loop", "end loop"},
    {Kind::For, Kind::Next, "for", "next"},
    {Kind::Select, Kind::EndSelect, "select", "end select"},
    {Kind::Sub, Kind::EndSub, "sub", "end sub"},
    {Kind::Function, Kind::EndFunction, "function", "end function"},
});

const OpenBlock* by_opener(Kind kind) {
  for (const auto& block : blocks)
    if (block.opener == kind)
      return &block;
  return nullptr;
}

bool parts(Kind part, Kind opener) {
  return part == Kind::Else     ? opener == Kind::If || opener == Kind::Select
         : part == Kind::ElseIf ? opener == Kind::If
                                : opener == Kind::Select;
}

/// Links the statements of each block. Large because most of it explains ends that are missing or
/// out of place, and offers to repair them.
class Linker {
public:
  Linker(Program& program, const File& file) : program_(program), file_(file) {}

  void run() {
    nested_ = balanced();
    for (auto i = file_.statements_begin; i < file_.statements_end; ++i) {
      const auto role = program_.statements[i].role();
      if (closes_block(role))
        close(i);
      else if (parts_block(role))
        part(i);
      else if (opens_block(role))
        open(i);
    }
    while (!open_.empty())
      leave_open();
    set_depths();
    // Neither correcting the foreign word of a stray end nor that of an unclosed opener would help,
    // so drop those findings.
    std::erase_if(program_.diagnostics, [&](const Diagnostic& one) {
      return one.rule == &rules::ForeignWord && alone_.contains(one.span.begin);
    });
  }

private:
  Kind role(std::uint32_t i) const { return program_.statements[i].role(); }

  /// True if the number of ends of subs equals the number of subs.
  bool balanced() const {
    int open = 0;
    for (auto i = file_.statements_begin; i < file_.statements_end; ++i)
      open += is_routine(role(i)) ? 1 : ends_routine(role(i)) ? -1 : 0;
    return open <= 0;
  }
  static bool is_routine(Kind kind) { return kind == Kind::Sub || kind == Kind::Function; }
  static bool ends_routine(Kind kind) { return kind == Kind::EndSub || kind == Kind::EndFunction; }

  /// Computes block depths; a block that is never closed does not count.
  void set_depths() {
    std::uint16_t depth = 0;
    for (auto i = file_.statements_begin; i < file_.statements_end; ++i) {
      auto& statement = program_.statements[i];
      const auto role = statement.role();
      if (closes_block(role) && statement.opener != none)
        --depth;
      statement.depth = depth;
      if (opens_block(role) && !endless_.contains(i))
        ++depth;
    }
  }

  void open(std::uint32_t i) {
    // Subs do not nest: if ends are missing, a sub ends the one above it.
    if (is_routine(role(i)) && !nested_)
      while (routines_ > 0)
        leave_open();
    routines_ += is_routine(role(i)) ? 1 : 0;
    if (open_.size() == deepest && !too_deep_) {
      too_deep_ = true;
      report(rules::NestingDepth, i, texts::BlocksTooDeep(deepest), texts::MoveIntoSub());
    }
    open_.push_back(i);
    last_.push_back(i);
  }

  /// Closes the innermost block, which has no end.
  void leave_open() {
    const auto i = open_.back();
    const auto* block = by_opener(role(i));
    if (i != excused_)
      report_unclosed(i, *block);
    endless_.insert(i);
    missing_.push_back(block->end);
    pop();
  }

  void report_unclosed(std::uint32_t i, const OpenBlock& block) {
    const auto where = program_.statements[i].word;
    const auto word = std::string(program_.text_of(where));
    if (!report(rules::UnclosedBlock, i, texts::Unterminated(word),
                equal_words(word, block.word) ? texts::WriteEnd(block.end_words)
                                              : texts::WriteBoth(block.word, block.end_words)))
      return;
    alone_.insert(where.begin);
    offer_end(i, block, program_.diagnostics.back());
  }

  /// The line number of a statement within its file.
  std::ptrdiff_t line_of(std::uint32_t i) const {
    const auto above = std::string_view(program_.text)
                           .substr(file_.begin, program_.statements[i].span.begin - file_.begin);
    return 1 + std::count(above.begin(), above.end(), line_end_of(program_.text).back());
  }

  /// Proposes the end of an unclosed block: at a bare `end` in the column of its opener, or where
  /// the indentation ends.
  void offer_end(std::uint32_t i, const OpenBlock& block, Diagnostic& d) const {
    const auto column = column_of(i);
    std::uint32_t last = none;
    for (auto j = i + 1; j < file_.statements_end; ++j) {
      const auto& statement = program_.statements[j];
      if (column_of(j) > column) {
        last = j;
        continue;
      }
      if (parts_block(statement.role()))
        continue;
      if (statement.kind == Kind::Broken)
        return; // it may be the end
      if (statement.role() == Kind::Robot && statement.robot == spec::Statement::End &&
          last != none) {
        d.help = texts::WriteOnLine(block.end_words, line_of(j));
        d.fix = single_fix(d.help, statement.span, std::string(block.end_words), Safety::Unsafe);
        return;
      }
      break;
    }
    if (last == none)
      return;
    const std::string_view text = program_.text;
    const auto after = std::min(text.find_first_of("\r\n", program_.statements[last].span.end),
                                std::size_t{file_.end});
    const auto at = static_cast<std::uint32_t>(after);
    d.fix = single_fix(d.help, {at, at},
                       fmt::format("\n{}{}", std::string(column, ' '), block.end_words),
                       Safety::Unsafe);
  }

  std::uint32_t column_of(std::uint32_t i) const {
    const auto begin = program_.statements[i].span.begin;
    const auto line = std::string_view(program_.text).substr(0, begin).find_last_of("\r\n");
    return line == std::string_view::npos ? begin : begin - static_cast<std::uint32_t>(line) - 1;
  }

  void pop() {
    routines_ -= is_routine(role(open_.back())) ? 1 : 0;
    open_.pop_back();
    last_.pop_back();
  }

  void link(std::uint32_t i) {
    program_.statements[i].opener = open_.back();
    program_.statements[last_.back()].next = i;
    last_.back() = i;
  }

  /// Closes unterminated blocks until `fits` is true; returns false if no open block fits.
  template <typename Fits>
  bool find(Fits fits) {
    const auto at = std::find_if(open_.rbegin(), open_.rend(),
                                 [&](std::uint32_t opener) { return fits(role(opener)); });
    if (at == open_.rend())
      return false;
    for (auto n = at - open_.rbegin(); n > 0; --n)
      leave_open();
    return true;
  }

  void close(std::uint32_t i) {
    const auto kind = role(i);
    if (!find([&](Kind opener) { return by_opener(opener)->end == kind; })) {
      stray_end(i);
      return;
    }
    link(i);
    pop();
  }

  /// Reports an end without a block: it may come too late, or be the wrong kind for the innermost
  /// block.
  void stray_end(std::uint32_t i) {
    const auto late = std::find(missing_.begin(), missing_.end(), role(i));
    if (late != missing_.end()) {
      missing_.erase(late);
      program_.statements[i].kind = program_.statements[i].meant = Kind::Broken;
      return;
    }
    report_stray(i);
    if (!open_.empty())
      excused_ = open_.back();
  }

  void part(std::uint32_t i) {
    const auto kind = role(i);
    if (!find([&](Kind opener) { return parts(kind, opener); })) {
      report_stray(i);
      return;
    }
    if (role(last_.back()) == Kind::Else)
      report(rules::BlockEnd, i, texts::ElseComesLast(), texts::MoveElse());
    link(i);
  }

  void report_stray(std::uint32_t i) {
    auto& statement = program_.statements[i];
    auto mend = mend_stray(i);
    if (report(rules::BlockEnd, i, texts::NoMatchingBlock(program_.text_of(statement.word)),
               std::move(mend.help))) {
      program_.diagnostics.back().fix = std::move(mend.fix);
      alone_.insert(statement.word.begin);
    }
    statement.kind = statement.meant = Kind::Broken;
  }

  struct Mend {
    Message help;
    std::optional<Fix> fix = {};
  };

  /// The replacement for an end or a part outside its block, or for the opener above it.
  Mend mend_stray(std::uint32_t i) const {
    const auto& statement = program_.statements[i];
    if (statement.role() == Kind::ElseIf)
      return {begin_if(statement)};
    if (parts_block(statement.role()))
      return {};
    if (open_.empty())
      return closes_block(statement.role()) ? Mend{texts::RemoveLine(), remove(statement)} : Mend{};
    const auto& opener = program_.statements[open_.back()];
    const auto reopen = [&](const std::string& word) {
      return single_fix(texts::Write(word), opener.word, word, Safety::Unsafe);
    };
    if (statement.role() == Kind::EndSub && returns_nothing(i))
      return {texts::WriteInstead("sub" + after_word(opener), "function"), reopen("sub")};
    if (statement.role() == Kind::Until && opener.role() == Kind::Loop)
      return {texts::WriteInstead("repeat", "loop"), reopen("repeat")};
    const auto* const block = by_opener(opener.role());
    const std::string end(block->end_words);
    Mend mend{texts::WriteBecause(end, texts::OpenBlock(block->word))};
    if (closes_block(statement.role()))
      mend.fix = single_fix(texts::Write(end), statement.span, end, Safety::Unsafe);
    return mend;
  }

  /// Removes a statement that is alone on its line.
  std::optional<Fix> remove(const Statement& statement) const {
    const std::string_view text = program_.text;
    const auto line = text.substr(0, statement.span.begin).find_last_of("\r\n") + 1;
    auto next = std::size_t{statement.span.end};
    next += text.substr(next).starts_with("\r\n") ? 2 : next < text.size() ? 1 : 0;
    if (text.find_first_not_of(" \t", line) != statement.span.begin ||
        text.find_first_of("\r\n", statement.span.end) != statement.span.end)
      return std::nullopt;
    return single_fix(texts::RemoveLine(),
                      {static_cast<std::uint32_t>(line), static_cast<std::uint32_t>(next)}, "",
                      Safety::Unsafe);
  }

  /// True if the innermost open block is a function that returns no value up to its `end sub`.
  bool returns_nothing(std::uint32_t end) const {
    if (open_.empty() || role(open_.back()) != Kind::Function)
      return false;
    for (auto n = open_.back(); n < end; ++n)
      if (role(n) == Kind::Return &&
          program_.statements[n].items_begin < program_.statements[n].items_end)
        return false;
    return true;
  }

  /// The `if` that a stray `elseif` may have meant; empty if it has no comparison.
  Message begin_if(const Statement& statement) const {
    auto condition = after_word(statement);
    if (condition.find_first_of("<>=") == std::string::npos)
      return {};
    condition.resize(condition.find_last_not_of(" \t:{") + 1);
    return texts::Write(
        fmt::format("if{}{}", condition, condition.ends_with(" then") ? "" : " then"));
  }

  /// The text of a statement after its word.
  std::string after_word(const Statement& statement) const {
    return program_.text.substr(statement.word.end, statement.span.end - statement.word.end);
  }

  /// Returns false for a line that does not parse: it already has a finding.
  bool report(const Rule& rule, std::uint32_t i, Message message, Message help) {
    const auto& statement = program_.statements[i];
    if (statement.kind == Kind::Broken)
      return false;
    program_.diagnostics.push_back(
        finding(rule, statement.word.size() > 0 ? statement.word : statement.span,
                std::move(message), std::move(help)));
    return true;
  }

  Program& program_;
  const File& file_;
  std::vector<std::uint32_t> open_; ///< the openers, outermost first
  std::vector<std::uint32_t> last_; ///< of each: its last part so far
  std::set<std::uint32_t> endless_; ///< openers without an end
  std::vector<Kind> missing_;       ///< their ends, which may still come
  std::uint32_t excused_ = none;    ///< an opener with a wrong end
  std::set<std::uint32_t> alone_;   ///< starts of stray ends and of unclosed openers
  int routines_ = 0;                ///< open subs and functions
  bool nested_ = false;             ///< subs contain subs
  bool too_deep_ = false;
};

} // namespace

std::optional<Kind> end_of_block(std::string_view word) {
  for (const auto& block : blocks)
    if (!word.empty() && equal_words(block.after_end(), word))
      return block.end;
  return std::nullopt;
}

Kind end_of(Kind opener) {
  const auto* const block = by_opener(opener);
  return block == nullptr ? Kind::Broken : block->end;
}

std::string_view words_of_end(Kind end) {
  for (const auto& block : blocks)
    if (block.end == end)
      return block.end_words;
  return {};
}

std::vector<std::string_view> words_after_end() {
  std::vector<std::string_view> words;
  for (const auto& block : blocks)
    if (!block.after_end().empty())
      words.push_back(block.after_end());
  return words;
}

bool opens_block(Kind kind) {
  return by_opener(kind) != nullptr;
}

bool parts_block(Kind kind) {
  return kind == Kind::ElseIf || kind == Kind::Else || kind == Kind::Case;
}

bool closes_block(Kind kind) {
  return std::any_of(blocks.begin(), blocks.end(),
                     [&](const OpenBlock& block) { return block.end == kind; });
}

bool is_loop(Kind kind) {
  return kind == Kind::While || kind == Kind::Repeat || kind == Kind::RepeatTimes ||
         kind == Kind::Loop || kind == Kind::For;
}

bool declares(Kind kind) {
  return kind == Kind::Const || kind == Kind::Array || kind == Kind::Sub ||
         kind == Kind::Function || kind == Kind::Use || kind == Kind::Include;
}

void link_blocks(Program& program, const File& file) {
  Linker(program, file).run();
}

} // namespace orb::structured
