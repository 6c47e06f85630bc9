#include "cli/terminal/diff.h"

#include "base/text/utf8.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <vector>

namespace orb::cli {
namespace {

constexpr std::size_t context_lines = 3;
constexpr std::size_t look_ahead = 32; // lines that may be added or removed at one place

/// Lines with their line ends.
std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size() - 1) + 1;
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return lines;
}

/// A run of lines: equal in both, or replaced.
struct DiffRun {
  std::size_t old_begin, old_end, new_begin, new_end;
  bool equal;
};

class Differ {
public:
  Differ(std::string_view before, std::string_view after)
      : old_(split(before)), new_(split(after)) {}

  std::string print(std::string_view name) {
    walk();
    if (runs_.size() == 1 && runs_[0].equal)
      return {};
    std::string out = fmt::format("--- a/{0}\n+++ b/{0}\n", shown_name(name));
    for (std::size_t i = 0; i < runs_.size();)
      i = runs_[i].equal ? i + 1 : print_hunk(out, i);
    return out;
  }

private:
  /// Formatting changes lines one by one, so the next equal pair is close. Taking the nearest one
  /// always gives a correct diff, and nearly always the shortest.
  void walk() {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < old_.size() || j < new_.size()) {
      if (i < old_.size() && j < new_.size() && old_[i] == new_[j]) {
        add({i, i + 1, j, j + 1, true});
        ++i;
        ++j;
        continue;
      }
      const auto [a, b] = nearest(i, j);
      add({i, i + a, j, j + b, false});
      i += a;
      j += b;
    }
  }

  std::pair<std::size_t, std::size_t> nearest(std::size_t i, std::size_t j) const {
    for (std::size_t sum = 1; sum <= look_ahead; ++sum)
      for (std::size_t a = 0; a <= sum; ++a) {
        const auto b = sum - a;
        if (i + a < old_.size() && j + b < new_.size() && old_[i + a] == new_[j + b])
          return {a, b};
      }
    return {i < old_.size() ? 1 : 0, j < new_.size() ? 1 : 0};
  }

  void add(const DiffRun& step) {
    if (!runs_.empty() && runs_.back().equal == step.equal) {
      runs_.back().old_end = step.old_end;
      runs_.back().new_end = step.new_end;
    } else {
      runs_.push_back(step);
    }
  }

  /// Prints the change at step `i`, including following ones whose contexts touch; returns the step
  /// after them.
  std::size_t print_hunk(std::string& out, std::size_t i) {
    auto last = i;
    while (last + 2 < runs_.size() &&
           runs_[last + 1].old_end - runs_[last + 1].old_begin <= 2 * context_lines)
      last += 2;
    const auto lead =
        i == 0 ? 0 : std::min(context_lines, runs_[i - 1].old_end - runs_[i - 1].old_begin);
    const auto tail =
        last + 1 < runs_.size()
            ? std::min(context_lines, runs_[last + 1].old_end - runs_[last + 1].old_begin)
            : 0;
    const auto old_begin = runs_[i].old_begin - lead;
    const auto new_begin = runs_[i].new_begin - lead;
    const auto old_size = runs_[last].old_end + tail - old_begin;
    const auto new_size = runs_[last].new_end + tail - new_begin;
    out += fmt::format("@@ -{},{} +{},{} @@\n", old_size == 0 ? old_begin : old_begin + 1, old_size,
                       new_size == 0 ? new_begin : new_begin + 1, new_size);
    put(out, ' ', old_, old_begin, runs_[i].old_begin);
    for (auto n = i; n <= last; ++n) {
      if (runs_[n].equal) {
        put(out, ' ', old_, runs_[n].old_begin, runs_[n].old_end);
        continue;
      }
      put(out, '-', old_, runs_[n].old_begin, runs_[n].old_end);
      put(out, '+', new_, runs_[n].new_begin, runs_[n].new_end);
    }
    put(out, ' ', old_, runs_[last].old_end, runs_[last].old_end + tail);
    return last + 1;
  }

  static void put(std::string& out, char mark, const std::vector<std::string_view>& lines,
                  std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      out += mark;
      out += lines[i];
      if (!lines[i].ends_with('\n'))
        out += "\n\\ No newline at end of file\n";
    }
  }

  std::vector<std::string_view> old_;
  std::vector<std::string_view> new_;
  std::vector<DiffRun> runs_;
};

} // namespace

std::string unified_diff(std::string_view name, std::string_view before, std::string_view after) {
  return before == after ? std::string() : Differ(before, after).print(name);
}

} // namespace orb::cli
