#include "base/fixes.h"

#include <iterator>
#include <map>

namespace orb {
namespace {

/// The edits taken so far, by where they begin.
class Edits {
public:
  /// Takes all edits of a fix, or none when one touches what was taken before.
  bool take(const Fix& fix) {
    for (const auto& edit : fix.edits)
      if (touches(edit.span))
        return false;
    for (const auto& edit : fix.edits)
      taken_.emplace(edit.span.begin, &edit);
    return true;
  }

  std::string apply(std::string_view text) const {
    std::string out;
    std::size_t at = 0;
    for (const auto& [begin, edit] : taken_) {
      out += text.substr(at, begin - at);
      out += edit->text;
      at = edit->span.end;
    }
    out += text.substr(at);
    return out;
  }

private:
  bool touches(Span span) const {
    const auto next = taken_.lower_bound(span.begin);
    if (next != taken_.end() && (next->first < span.end || next->first == span.begin))
      return true;
    return next != taken_.begin() && std::prev(next)->second->span.end > span.begin;
  }

  std::map<std::uint32_t, const Edit*> taken_;
};

} // namespace

Fixed apply_fixes(std::string_view text, const std::vector<Diagnostic>& diagnostics) {
  Edits edits;
  Fixed fixed;
  for (const auto& diagnostic : diagnostics)
    if (diagnostic.fix && diagnostic.fix->safety == Safety::Safe && edits.take(*diagnostic.fix))
      ++fixed.count;
  fixed.text = edits.apply(text);
  return fixed;
}

} // namespace orb
