#include "vm/macros/macro_store.h"

#include <algorithm>
#include <functional>

namespace orb::vm {

ByteView MacroStore::find(std::uint8_t id) const {
  if (id == spec::macro_id_temporary)
    return ByteView(buffer_).first(holds_stream_ ? 0 : buffer_used_);
  for (const auto& entry : std::span(entries_).first(entry_count_))
    if (entry.id == id)
      return ByteView(heap_).subspan(entry.offset, entry.size);
  return {};
}

ByteView MacroStore::moved(ByteView view, const MacroStore& from) const {
  const auto in = [&](const auto& bytes, const auto& here) -> std::optional<ByteView> {
    const std::less_equal<const std::uint8_t*> up_to;
    if (view.empty() || !up_to(bytes.data(), view.data()) ||
        !up_to(view.data() + view.size(), bytes.data() + bytes.size()))
      return std::nullopt;
    const auto offset = static_cast<std::size_t>(view.data() - bytes.data());
    return ByteView(here).subspan(offset, view.size());
  };
  if (const auto found = in(from.buffer_, buffer_))
    return *found;
  return in(from.heap_, heap_).value_or(view);
}

bool MacroStore::save_user(std::uint8_t id, ByteView image) {
  if (!find(id).empty() || entry_count_ == entries_.size() ||
      image.size() > heap_.size() - heap_used_)
    return false;
  std::copy(image.begin(), image.end(), heap_.data() + heap_used_);
  entries_[entry_count_++] = {id, static_cast<std::uint16_t>(heap_used_),
                              static_cast<std::uint16_t>(image.size())};
  heap_used_ += image.size();
  return true;
}

void MacroStore::forget_users() {
  entry_count_ = 0;
  heap_used_ = 0;
}

void MacroStore::clear_buffer() {
  buffer_used_ = 0;
  holds_stream_ = false;
  closed_ = false;
}

bool MacroStore::append_temporary(ByteView bytes) {
  if (holds_stream_ || closed_)
    clear_buffer();
  if (bytes.size() > buffer_.size() - buffer_used_)
    return false;
  std::copy(bytes.begin(), bytes.end(), buffer_.data() + buffer_used_);
  buffer_used_ += bytes.size();
  if (buffer_used_ > 0)
    buffer_[0] = spec::macro_id_temporary;
  return true;
}

std::optional<std::uint32_t> MacroStore::append_stream(ByteView commands, std::uint32_t live_from) {
  // Keep one byte free for the pause that the robot appends to the last chunk.
  const auto capacity = buffer_.size() - 1;
  std::uint32_t shift = 0;
  holds_stream_ = true;
  if (commands.size() > capacity - buffer_used_) {
    if (commands.size() > capacity - (buffer_used_ - live_from))
      return std::nullopt;
    std::copy(buffer_.data() + live_from, buffer_.data() + buffer_used_, buffer_.data());
    buffer_used_ -= live_from;
    shift = live_from;
  }
  std::copy(commands.begin(), commands.end(), buffer_.data() + buffer_used_);
  buffer_used_ += commands.size();
  return shift;
}

} // namespace orb::vm
