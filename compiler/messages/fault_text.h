#pragma once

#include "base/diagnostic.h"
#include "compiler/text/parse.h"
#include "compiler/text/program.h"
#include "compiler/text/texts.h"
#include "compiler/text/words.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace orb::compiler {

/// A fault with the text around it. Private to compiler/.
class FaultText {
public:
  FaultText(const Program& program, const Fault& fault)
      : program_(program), fault_(fault), text_(program.text), line_(program.lines[fault.line]) {}

  std::string_view token() const { return program_.text_of(fault_.span); }

  /// The first place from `offset` on, within the line, that is not a blank.
  std::uint32_t skip_blanks(std::uint32_t offset) const {
    while (offset < line_.span.end && is_blank(text_[offset]))
      ++offset;
    return offset;
  }
  /// The end of what stands before `offset`, blanks left out.
  std::uint32_t skip_back(std::uint32_t offset) const {
    while (offset > line_.span.begin && is_blank(text_[offset - 1]))
      --offset;
    return offset;
  }
  /// The last character before `offset` that is not a blank; NUL at the start of the line.
  char before(std::uint32_t offset) const {
    offset = skip_back(offset);
    return offset > line_.span.begin ? text_[offset - 1] : '\0';
  }
  /// The first character from `offset` on that is not a blank; NUL at the end of the line.
  char after(std::uint32_t offset) const {
    offset = skip_blanks(offset);
    return offset < line_.span.end ? text_[offset] : '\0';
  }
  /// The word that begins at `offset`; empty where none does.
  Span word_at(std::uint32_t offset) const {
    auto end = offset;
    while (end < line_.span.end && is_letter(text_[end]))
      ++end;
    return {offset, end};
  }
  /// Where the line's statement ends: before the comment and the blanks in front of it.
  std::uint32_t code_end() const {
    return skip_back(line_.comment.size() > 0 ? line_.comment.begin : line_.span.end);
  }

  /// What shows how the statement is written: its example.
  Message form() const {
    const auto example = spec::info(fault_.statement).example;
    return texts::WriteLike(example.substr(example.find(' ') + 1));
  }

  /// Sets a safe fix, if the line has no fault with it or its first one stands after the last
  /// edit.
  void offer(Diagnostic& d, Message title, std::vector<Edit> edits) const {
    std::string line(program_.text_of(line_.span));
    std::size_t last = 0;
    for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit) {
      line.replace(edit->span.begin - line_.span.begin, edit->span.size(), edit->text);
      last += edit == edits.rbegin() ? edit->span.begin - line_.span.begin : 0;
      last += edit->text.size() - (edit == edits.rbegin() ? 0 : edit->span.size());
    }
    const auto faults = parse(line).faults;
    last += edits.size() == 1 && edits[0].text.empty() ? 1 : 0; // what follows must not be the next
    if (faults.empty() || faults[0].line > 0 || faults[0].span.begin >= last)
      d.fix = Fix{std::move(title), std::move(edits), Safety::Safe};
  }

protected:
  const Program& program_;
  const Fault& fault_;
  std::string_view text_;
  const Line& line_;
};

} // namespace orb::compiler
