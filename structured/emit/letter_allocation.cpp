#include "structured/emit/letter_allocation.h"

#include "spec/limits.h"
#include "structured/analyse/interference.h"

#include <algorithm>
#include <limits>

namespace orb::structured {
namespace {

constexpr std::uint8_t index_letter = 24; // Y
static_assert(index_letter + 1 == spec::value_of(spec::Limit::DirectVariables));

/// Colours the classes; returns false if there are too few letters.
class Colouring {
public:
  Colouring(const Classes& classes, const std::vector<bool>& used,
            const std::vector<std::uint8_t>& wishes, std::uint32_t letters, bool index_used)
      : classes_(classes), wishes_(wishes), letters_(letters) {
    for (std::uint32_t v = 0; v < used.size(); ++v) {
      bool any = false;
      if (classes.find(v) == v)
        each_member(classes.members(v), [&](std::uint32_t member) { any = any || used[member]; });
      if (any && v != index_variable)
        roots_.push_back(v);
    }
    find_neighbours(used.size());
    letter_.assign(used.size(), no_letter);
    if (index_used)
      letter_[index_variable] = index_letter;
  }

  bool run() {
    for (const auto root : order())
      if (!colour(root))
        return false;
    return true;
  }

  std::uint8_t letter(std::uint32_t v) const { return letter_[classes_.find(v)]; }

private:
  void find_neighbours(std::size_t variables) {
    neighbours_.resize(variables);
    std::vector<std::uint32_t> last(variables, none); // the class that last counted it
    for (const auto root : roots_)
      each_member(classes_.edges(root), [&](std::uint32_t v) {
        const auto other = classes_.find(v);
        if (other == root || other == index_variable || last[other] == root)
          return;
        last[other] = root;
        neighbours_[root].push_back(other);
      });
  }

  /// Orders those with few neighbours last: they always find a letter.
  std::vector<std::uint32_t> order() const {
    constexpr auto gone = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> degree(neighbours_.size());
    for (const auto root : roots_)
      degree[root] = neighbours_[root].size();
    std::vector<std::uint32_t> ordered;
    for (std::size_t n = 0; n < roots_.size(); ++n) {
      const auto least =
          *std::min_element(roots_.begin(), roots_.end(), [&](std::uint32_t a, std::uint32_t b) {
            return degree[a] < degree[b];
          });
      degree[least] = gone;
      ordered.push_back(least);
      for (const auto neighbour : neighbours_[least])
        if (degree[neighbour] != gone)
          --degree[neighbour];
    }
    std::reverse(ordered.begin(), ordered.end());
    return ordered;
  }

  bool colour(std::uint32_t root) {
    std::uint32_t taken = 0;
    for (const auto other : neighbours_[root])
      if (letter_[other] != no_letter)
        taken |= std::uint32_t{1} << letter_[other];
    const auto is_free = [&](std::uint8_t letter) {
      return letter < letters_ && (taken >> letter & 1) == 0;
    };
    auto& letter = letter_[root];
    each_member(classes_.members(root), [&](std::uint32_t member) {
      if (letter == no_letter && wishes_[member] != no_letter && is_free(wishes_[member]))
        letter = wishes_[member];
    });
    for (std::uint8_t any = 0; letter == no_letter && any < letters_; ++any)
      if (is_free(any))
        letter = any;
    return letter != no_letter;
  }

  const Classes& classes_;
  const std::vector<std::uint8_t>& wishes_;
  std::uint32_t letters_;
  std::vector<std::uint32_t> roots_;
  std::vector<std::vector<std::uint32_t>> neighbours_; ///< of each root: roots
  std::vector<std::uint8_t> letter_;
};

} // namespace

LetterAllocation choose_letters(const Code& code, const std::vector<std::uint8_t>& wishes) {
  const Interference interference(code);
  const auto count = code.variables.size();
  const bool index_used = interference.used[index_variable];
  LetterAllocation letters;
  letters.of.assign(count, no_letter);
  letters.available = static_cast<std::uint32_t>(spec::value_of(spec::Limit::DirectVariables)) -
                      (index_used ? 1 : 0);
  for (const bool together : {true, false}) {
    Classes classes(interference.edges, count);
    if (together)
      each_copy(code, [&](std::uint32_t a, std::uint32_t b) { classes.join(a, b); });
    Colouring colouring(classes, interference.used, wishes, letters.available, index_used);
    if (!colouring.run())
      continue;
    for (std::uint32_t v = 0; v < count; ++v)
      letters.of[v] = colouring.letter(v);
    return letters;
  }
  letters.crowded_line = interference.crowded_line;
  for (std::uint32_t v = 0; v < count; ++v)
    if (contains(interference.crowd, v))
      letters.crowd.push_back(v);
  return letters;
}

} // namespace orb::structured
