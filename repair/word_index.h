#pragma once

#include "base/text/text.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace orb::repair {

/// An index of lists of words: finds the numbers of the lists that contain a word. Case does not
/// count.
class WordIndex {
public:
  WordIndex() = default;
  /// Numbers the lists from 0; `words` gives the space-separated words of a row.
  template <typename Rows, typename Words>
  WordIndex(const Rows& rows, Words words) {
    for (std::size_t i = 0; i < std::size(rows); ++i)
      for (const auto word : words_in(words(rows[i])))
        add(word, i);
  }

  void add(std::string_view word, std::size_t list) {
    auto& lists = lists_[lower(word)];
    if (lists.empty() || lists.back() != list)
      lists.push_back(list);
  }

  /// In insertion order.
  const std::vector<std::size_t>& lists_of(std::string_view word) const {
    static const std::vector<std::size_t> none;
    const auto found = lists_.find(lower(word));
    return found == lists_.end() ? none : found->second;
  }

private:
  std::unordered_map<std::string, std::vector<std::size_t>> lists_;
};

} // namespace orb::repair
