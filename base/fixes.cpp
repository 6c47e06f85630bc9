#include "base/fixes.h"

#include "base/texts.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace orb {
namespace {

/// The edits accepted so far, by their start.
class Edits {
public:
  /// Accepts all edits of a fix, or none if one touches an accepted edit.
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

bool is_safe(const Diagnostic& diagnostic) {
  return diagnostic.fix && diagnostic.fix->safety == Safety::Safe;
}

std::ptrdiff_t errors_in(const std::vector<Diagnostic>& findings) {
  return std::count_if(findings.begin(), findings.end(), keeps_from_building);
}

/// The span of `to` that differs from `from`.
Span changed(std::string_view from, std::string_view to) {
  const auto most = std::min(from.size(), to.size());
  std::size_t left = 0;
  while (left < most && from[left] == to[left])
    ++left;
  std::size_t right = 0;
  while (right < most - left && from[from.size() - 1 - right] == to[to.size() - 1 - right])
    ++right;
  while (left > 0 && to[left - 1] != '\n' && to[left - 1] != '\r')
    --left;
  auto end = to.size() - right;
  while (end < to.size() && to[end] != '\n' && to[end] != '\r')
    ++end;
  return {static_cast<std::uint32_t>(left), static_cast<std::uint32_t>(end)};
}

/// The increase in errors per rule. Errors inside `shown` do not count: the fixed mistake hid them.
std::map<const Rule*, int> more_errors(const std::vector<Diagnostic>& before,
                                       const std::vector<Diagnostic>& after, Span shown) {
  std::map<const Rule*, int> more;
  for (const auto& d : before)
    more[d.rule] -= keeps_from_building(d) ? 1 : 0;
  for (const auto& d : after)
    more[d.rule] += keeps_from_building(d) && !is_safe(d) &&
                            (d.span.begin < shown.begin || d.span.begin > shown.end)
                        ? 1
                        : 0;
  return more;
}

/// True if the second text is better: no rule has more errors, and there are fewer errors in all,
/// fewer findings, or fewer of the rule `mended`.
bool is_better(const std::vector<Diagnostic>& before, const std::vector<Diagnostic>& after,
               Span shown, const Rule* mended) {
  const auto more = more_errors(before, after, shown);
  if (std::any_of(more.begin(), more.end(), [](const auto& one) { return one.second > 0; }))
    return false;
  const auto of_kind = [&](const std::vector<Diagnostic>& all) {
    return std::count_if(all.begin(), all.end(),
                         [&](const Diagnostic& d) { return d.rule == mended; });
  };
  return errors_in(after) <= errors_in(before) || of_kind(after) < of_kind(before);
}

/// Identifies a fix across rounds.
std::string key_of(std::string_view text, const Diagnostic& diagnostic) {
  std::string key(diagnostic.rule == nullptr ? "" : diagnostic.rule->id);
  for (const auto& edit : diagnostic.fix->edits)
    key += '\n' + std::string(text.substr(edit.span.begin, edit.span.size())) + '\n' + edit.text;
  return key;
}

} // namespace

Fix single_fix(Message title, Span span, std::string text, Safety safety) {
  return Fix{std::move(title), {Edit{span, std::move(text)}}, safety};
}

Fixed apply_fixes(std::string_view text, const std::vector<Diagnostic>& diagnostics) {
  Edits edits;
  Fixed fixed;
  for (const auto& diagnostic : diagnostics)
    if (is_safe(diagnostic) && edits.take(*diagnostic.fix))
      ++fixed.count;
  fixed.text = edits.apply(text);
  return fixed;
}

void say_lines(std::string_view text, std::vector<Diagnostic>& diagnostics) {
  for (auto& d : diagnostics) {
    if (!d.help.empty() || !d.fix || d.span.begin > text.size())
      continue;
    const auto before = text.find_last_of("\r\n", d.span.begin == 0 ? 0 : d.span.begin - 1);
    const auto begin = d.span.begin == 0 || before == std::string_view::npos ? 0 : before + 1;
    const auto end = std::min(text.find_first_of("\r\n", begin), text.size());
    std::string line(text.substr(begin, end - begin));
    bool within = true;
    for (auto edit = d.fix->edits.rbegin(); within && edit != d.fix->edits.rend(); ++edit) {
      within = edit->span.begin >= begin && edit->span.end <= end &&
               edit->text.find_first_of("\r\n") == std::string::npos;
      if (within)
        line.replace(edit->span.begin - begin, edit->span.size(), edit->text);
    }
    if (within)
      d.help = texts::Write(line.substr(std::min(line.find_first_not_of(" \t"), line.size())));
  }
}

Fixed fix_all(std::string text, const Check& check) {
  // Keep the findings of the accepted text: the next round starts from them.
  std::string last;
  std::vector<Diagnostic> found;
  bool any = false;
  const auto once = [&](std::string_view changed) {
    if (!any || changed != last) {
      last = changed;
      found = check(changed);
      any = true;
    }
    return found;
  };
  return fix_all(std::move(text), once, once);
}

Fixed fix_all(std::string text, const Check& check, const Check& judge) {
  // A mistake can hide the next one on its line, so a few rounds are normal. The limit stops two
  // fixes that undo each other from looping forever.
  constexpr int most_rounds = 64;
  Fixed all{std::move(text), 0};
  auto findings = check(all.text);
  auto judged = judge(all.text);
  std::set<std::string> refused;
  const auto take = [&](Fixed made, Span shown, const Rule* mended) {
    auto after = judge(made.text);
    if (!is_better(judged, after, shown, mended))
      return false;
    all.text = std::move(made.text);
    all.count += made.count;
    judged = std::move(after);
    findings = check(all.text);
    refused.clear();
    return true;
  };
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<Diagnostic> open;
    for (const auto& d : findings)
      if (is_safe(d) && refused.count(key_of(all.text, d)) == 0)
        open.push_back(d);
    if (open.empty())
      break;
    if (open.size() > 1 && take(apply_fixes(all.text, open), {}, nullptr))
      continue;
    for (const auto& d : open) {
      auto made = apply_fixes(all.text, {d});
      const auto shown = changed(all.text, made.text);
      if (take(std::move(made), shown, d.rule))
        break;
      refused.insert(key_of(all.text, d));
    }
  }
  return all;
}

} // namespace orb
