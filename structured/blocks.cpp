#include "structured/blocks.h"

#include "structured/rules.h"
#include "structured/words.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace orb::structured {
namespace {

constexpr std::size_t deepest = 64;

struct Block {
  Kind opener;
  Kind end;
  std::string_view word; ///< of the opener
  std::string_view end_words;

  /// The word that follows `end`; empty where the block ends in another way.
  constexpr std::string_view after_end() const {
    constexpr std::string_view end_word = "end ";
    return end_words.starts_with(end_word) ? end_words.substr(end_word.size()) : std::string_view();
  }
};

constexpr auto blocks = std::to_array<Block>({
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

const Block* by_opener(Kind kind) {
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

class Linker {
public:
  Linker(Program& program, const File& file) : program_(program), file_(file) {}

  void run() {
    for (auto i = file_.statements_begin; i < file_.statements_end; ++i) {
      auto& statement = program_.statements[i];
      if (closes_block(statement.kind))
        close(i);
      else if (parts_block(statement.kind))
        part(i);
      statement.depth = static_cast<std::uint16_t>(open_.size());
      if (opens_block(statement.kind))
        open(i);
    }
    while (!open_.empty())
      leave_open();
  }

private:
  void open(std::uint32_t i) {
    if (open_.size() == deepest && !too_deep_) {
      too_deep_ = true;
      report(rules::NestingDepth, i, fmt::format("more than {} blocks are open here", deepest),
             "put a part into a sub");
    }
    open_.push_back(i);
    last_.push_back(i);
  }

  /// Ends the innermost block, which has no end of its own.
  void leave_open() {
    const auto& opener = program_.statements[open_.back()];
    const auto* block = by_opener(opener.kind);
    report(rules::UnclosedBlock, open_.back(),
           fmt::format("this `{}` is never closed", block->word),
           fmt::format("write `{}` after its last line", block->end_words));
    open_.pop_back();
    last_.pop_back();
  }

  void link(std::uint32_t i) {
    program_.statements[i].opener = open_.back();
    program_.statements[last_.back()].next = i;
    last_.back() = i;
  }

  /// Closes blocks without an end until `fits` says yes; false where no open block does.
  template <typename Fits>
  bool find(Fits fits) {
    const auto at = std::find_if(open_.rbegin(), open_.rend(), [&](std::uint32_t opener) {
      return fits(program_.statements[opener].kind);
    });
    if (at == open_.rend())
      return false;
    for (auto n = at - open_.rbegin(); n > 0; --n)
      leave_open();
    return true;
  }

  void close(std::uint32_t i) {
    const auto kind = program_.statements[i].kind;
    if (!find([&](Kind opener) { return by_opener(opener)->end == kind; })) {
      report_stray(i);
      return;
    }
    link(i);
    open_.pop_back();
    last_.pop_back();
  }

  void part(std::uint32_t i) {
    const auto kind = program_.statements[i].kind;
    if (!find([&](Kind opener) { return parts(kind, opener); })) {
      report_stray(i);
      return;
    }
    if (program_.statements[last_.back()].kind == Kind::Else)
      report(rules::BlockEnd, i, "the `else` above is the last part of its block",
             "move the `else` to the end");
    link(i);
  }

  void report_stray(std::uint32_t i) {
    auto& statement = program_.statements[i];
    const auto word = std::string(program_.text_of(statement.word));
    std::string help;
    if (!open_.empty()) {
      const auto* block = by_opener(program_.statements[open_.back()].kind);
      help = fmt::format("the open block is a `{}`; `{}` closes it", block->word, block->end_words);
    }
    report(rules::BlockEnd, i, fmt::format("no open block takes this `{}`", word), std::move(help));
    statement.kind = Kind::Broken;
  }

  void report(const Rule& rule, std::uint32_t i, std::string message, std::string help) {
    const auto& statement = program_.statements[i];
    program_.diagnostics.push_back(
        finding(rule, statement.word.size() > 0 ? statement.word : statement.span,
                std::move(message), std::move(help)));
  }

  Program& program_;
  const File& file_;
  std::vector<std::uint32_t> open_; ///< the openers, outermost first
  std::vector<std::uint32_t> last_; ///< of each: its last part so far
  bool too_deep_ = false;
};

} // namespace

std::optional<Kind> end_of_block(std::string_view word) {
  for (const auto& block : blocks)
    if (!word.empty() && equal_words(block.after_end(), word))
      return block.end;
  return std::nullopt;
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

bool is_loop_word(std::string_view word) {
  return std::any_of(blocks.begin(), blocks.end(), [&](const Block& block) {
    return is_loop(block.opener) && equal_words(block.word, word);
  });
}

bool opens_block(Kind kind) {
  return by_opener(kind) != nullptr;
}

bool parts_block(Kind kind) {
  return kind == Kind::ElseIf || kind == Kind::Else || kind == Kind::Case;
}

bool closes_block(Kind kind) {
  return std::any_of(blocks.begin(), blocks.end(),
                     [&](const Block& block) { return block.end == kind; });
}

bool is_loop(Kind kind) {
  return kind == Kind::While || kind == Kind::Repeat || kind == Kind::RepeatTimes ||
         kind == Kind::Loop || kind == Kind::For;
}

void link_blocks(Program& program, const File& file) {
  Linker(program, file).run();
}

} // namespace orb::structured
