#include "structured/optimise/long_prints.h"

#include "compiler/analyse/range.h"
#include "spec/limits.h"

#include <algorithm>
#include <utility>

namespace orb::structured {
namespace {

/// Cuts prints into pieces that fit.
class Cutter {
public:
  explicit Cutter(Code& code) : code_(code) {}

  void run() {
    if (std::none_of(code_.lines.begin(), code_.lines.end(), [&](const CodeLine& line) {
          return line.kind == LineKind::Print && width(line) > most_;
        }))
      return;
    auto lines = std::exchange(code_.lines, {});
    for (auto& line : lines) {
      if (line.kind == LineKind::Print && width(line) > most_)
        cut(line);
      else
        code_.lines.push_back(line);
    }
  }

private:
  std::uint32_t width(const Part& part) const {
    if (part.kind == PartKind::Text)
      return part.text.size();
    if (part.kind == PartKind::Term)
      return compiler::printed(part.range).most;
    return part.kind == PartKind::Character || part.kind == PartKind::Blank ? 1 : 0;
  }
  std::uint32_t width(const CodeLine& line) const {
    std::uint32_t sum = 0;
    for (auto i = line.parts_begin; i < line.parts_end; ++i)
      sum += width(code_.parts[i]);
    return sum;
  }

  /// Computes the items with side effects before any of them is printed.
  void hoist(const CodeLine& line) {
    for (auto i = line.parts_begin; i < line.parts_end; ++i) {
      auto& part = code_.parts[i];
      if (part.kind != PartKind::Term && part.kind != PartKind::Character)
        continue;
      if ((code_.terms[part.value].effects & (effect::faults | effect::clears)) == 0)
        continue;
      auto let = line;
      let.kind = LineKind::Let;
      let.variable = code_.new_variable();
      let.term = part.value;
      code_.lines.push_back(let);
      part.value = code_.read(let.variable);
    }
  }

  void cut(const CodeLine& line) {
    hoist(line);
    const std::vector<Part> parts(code_.parts.begin() + line.parts_begin,
                                  code_.parts.begin() + line.parts_end);
    begin(line);
    auto rest = width(line);
    for (auto part : parts) {
      // Keep a text whole if cutting it would not save a piece.
      if (used_ + width(part) > most_ && rest <= most_)
        next(line);
      rest -= width(part);
      while (part.kind == PartKind::Text && used_ + width(part) > most_) {
        auto head = part;
        head.text.end = head.text.begin + most_ - used_;
        if (head.text.size() > 0)
          code_.parts.push_back(head);
        part.text.begin = head.text.end;
        next(line);
      }
      if (used_ + width(part) > most_)
        next(line);
      if (part.kind == PartKind::Text && part.text.size() == 0)
        continue;
      code_.parts.push_back(part);
      used_ += width(part);
    }
    end(line);
  }

  void begin(const CodeLine& line) {
    piece_ = line;
    piece_.parts_begin = static_cast<std::uint32_t>(code_.parts.size());
    used_ = 0;
  }
  void end(const CodeLine&) {
    piece_.parts_end = static_cast<std::uint32_t>(code_.parts.size());
    code_.lines.push_back(piece_);
  }
  void next(const CodeLine& line) {
    code_.parts.push_back({PartKind::Open, none, {}, {}});
    end(line);
    begin(line);
  }

  Code& code_;
  CodeLine piece_;
  std::uint32_t used_ = 0;
  std::uint32_t most_ = static_cast<std::uint32_t>(spec::value_of(spec::Limit::PrintBytes));
};

} // namespace

void cut_prints(Code& code) {
  Cutter(code).run();
}

} // namespace orb::structured
