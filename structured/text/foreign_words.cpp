#include "structured/text/foreign_words.h"

#include "base/fixes.h"
#include "base/text/text.h"
#include "repair/idioms.h"
#include "structured/text/rules.h"
#include "structured/text/structured_words.h"
#include "structured/text/texts.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace orb::structured {
namespace {

using enum Stands;

constexpr std::string_view loops = "for do while loop repeat until";

constexpr auto rows = std::to_array<Foreign>({
    {First, "elif", "", "elseif", "Python"},
    {First, "elsif", "", "elseif", "Ruby"},
    {First, "else", "if", "elseif", "JavaScript"},
    {First, "switch", "", "select", "C"},
    {First, "select", "case", "select", "Visual Basic"},
    {First, "default", "", "else", "C"},
    {First, "break", "", "exit", "Python/C"},
    {First, "exit", loops, "exit", "Visual Basic"},
    {First, "continue", loops, "continue", "Visual Basic"},
    {First, "exit", "sub function", "return", "Visual Basic"},
    {First, "do", "while", "while", "BASIC"},
    {First, "do", "until", "while not", "BASIC"},
    {First, "do", "", "loop", "BASIC"},
    {First, "loop", "until", "until", "BASIC"},
    {First, "loop", "while", "until not", "BASIC"},
    {First, "loop", "", block_end, "BASIC"},
    {First, "wend endwhile", "", "end while", "BASIC"},
    {First, "endif", "", "end if", "BASIC"},
    {First, "endselect endswitch", "", "end select", "BASIC"},
    {First, "endloop enddo", "", "end loop", "BASIC"},
    {First, "endrepeat", "", "end repeat", "BASIC"},
    {First, "endfor", "", "next", "PHP"},
    {First, "end", "for", "next", "Lua"},
    {First, "end", "switch case", "end select", "BASIC"},
    {First, "endsub endproc", "", "end sub", "BASIC"},
    {First, "endfunction endfunc", "", "end function", "BASIC"},
    {First, "enddef", "", block_end, "Python"},
    {First, "end", "def proc procedure void func", block_end, "BASIC"},
    {First, "}", "else elseif elif", "", "C/JavaScript"},
    {First, "}", "", block_end, "C/JavaScript"},
    {First, "def", "", "sub", "Python"},
    {First, "proc procedure", "", "sub", "Pascal"},
    {First, "void", "loop", "loop", "Arduino"},
    {First, "void", "", "sub", "C"},
    {First, "func", "", "function", "Go/Swift"},
    {First, "var let", "", "", "JavaScript"},
    {First, "call", "", "", "Visual Basic"},
    {First, "int long byte", "", "", "C"},
    {First, "set", "", "", "Scratch"},
    {Named, "void", "setup main", "", "Arduino"},
    {Named, "forever", "", "loop", "Scratch"},
    {Named, "say", "", "print", "Scratch"},
    {Named, "echo", "", "print", "PHP"},
    {Named, "printf println", "", "print", "C/Java"},
    {Last, ";", "", "", "C/JavaScript"},
    {Last, ":", "", "", "Python"},
    {Last, "{", "", "", "C/JavaScript"},
    {Inside, "==", "", "=", "Python/C"},
    {Inside, ":=", "", "=", "Pascal"},
    {Inside, "&&", "", "and", "C/JavaScript"},
    {Inside, "||", "", "or", "C/JavaScript"},
    {Inside, "!", "", "not", "C/JavaScript"},
    {Inside, "//", "", "/", "Python"},
    {Inside, "mod", "", "%", "BASIC"},
    {Inside, "sqr", "", "sqrt", "BASIC"},
    {Inside, "rand random randint", "", "rnd", "Python/C", &texts::DiceInstead},
    {Inside, "^", "", "", "BASIC", &texts::NoPower},
    {Inside, "is", "", "", "BASIC/Python", &texts::CaseLists},
    {Inside, "heading", "", "", "", &texts::HeadingIsYaw},
    {Inside, "{ }", "", "", "C/JavaScript", &texts::NoBraces},
    {Inside, "do times", "", "", "Scratch", &texts::RemoveIt},
    {Remark, "//", "", "'", "C/JavaScript"},
    {Remark, "/*", "", "'", "C/JavaScript"},
    {Remark, "#", "", "'", "Python"},
    {Remark, "rem", "", "'", "BASIC"},
    {Remark, "--", "", "'", "Lua"},
});

} // namespace

const Foreign* find_foreign(Stands stands, std::string_view word, std::string_view after) {
  const auto* const row = std::find_if(rows.begin(), rows.end(), [&](const Foreign& one) {
    return one.stands == stands && holds(one.words, word) &&
           (one.after.empty() || holds(one.after, after));
  });
  return row == rows.end() ? nullptr : row;
}

Diagnostic foreign(const Program& program, Span found, std::string_view languages,
                   std::string_view here) {
  const auto word = program.text_of(found);
  auto d = finding(rules::ForeignWord, found,
                   languages.empty() ? texts::NotOfThisLanguage(word)
                   : here.empty()    ? texts::Needless(word, languages)
                                     : texts::WrittenAs(word, languages, here),
                   here.empty() ? texts::RemoveIt() : texts::Write(here));
  const std::string_view text = program.text;
  if (here.empty() && is_blank(text[found.end])) // remove the adjacent spaces, too
    found.end = static_cast<std::uint32_t>(text.find_first_not_of(" \t", found.end));
  else
    while (here.empty() && found.begin > 0 && is_blank(text[found.begin - 1]))
      --found.begin;
  const auto gap = [&](std::uint32_t beside, std::string_view signs) { // `a&&b` is `a and b`
    const char c = text[beside];
    return here.size() > 1 && (is_name_char(c) || signs.find(c) != std::string_view::npos) ? " "
                                                                                           : "";
  };
  d.fix = single_fix(d.help, found,
                     fmt::format("{}{}{}", found.begin > 0 ? gap(found.begin - 1, ")]") : "", here,
                                 gap(found.end, is_name_char(word.back()) ? "" : "(")),
                     Safety::Safe);
  return d;
}

std::optional<Diagnostic> name_foreign(const Program& program, Span found, Stands stands) {
  const std::string_view text = program.text;
  // The parser stops at the second of two characters.
  for (const auto begin : {found.begin - std::min(found.begin, 1U), found.begin})
    if (const auto* const row = find_foreign(stands, text.substr(begin, 2));
        row != nullptr && !is_letter(text[begin])) {
      auto d = foreign(program, {begin, begin + 2}, row->languages, row->here);
      if (row->here == "/") // it may have meant a comment
        d.fix->safety = Safety::Unsafe;
      return d;
    }
  const auto word = program.text_of(found);
  const auto* row = stands == First ? find_foreign(Named, word) : nullptr;
  if (row == nullptr)
    row = find_foreign(stands, word);
  const bool ours = find_word(word).kind == WordKind::Keyword;
  if (row == nullptr &&
      (ours ||
       !repair::is_known_word(word, stands == First ? repair::Where::Line : repair::Where::Inside)))
    return std::nullopt;
  auto d = foreign(program, found, row == nullptr ? "" : row->languages,
                   row == nullptr ? "" : row->here);
  if (find_word(word).kind == WordKind::Statement)
    d.message = texts::StatementNoValue(word);
  if (row != nullptr && row->help != nullptr)
    d.help = Message(*row->help, {});
  if (row == nullptr || row->here.empty())
    d.fix.reset();
  else
    d.fix->safety = Safety::Unsafe;
  if (row == nullptr)
    d.help = {};
  return d;
}

} // namespace orb::structured
