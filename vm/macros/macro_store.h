#pragma once

#include "base/bytes.h"
#include "spec/macro.h"

#include <array>
#include <cstdint>
#include <optional>

namespace orb::vm {

/// Where a ball keeps its macros: one buffer that the temporary and the stream macro share, and a
/// heap for user macros with an index that sleep forgets. A plain value.
/// Source: low-level API §User Macros, §The Stream Macro.
class MacroStore {
public:
  /// The image (id, flags, body) of a user or temporary macro; empty where there is none.
  ByteView find(std::uint8_t id) const;

  /// The bytes here that `view` is of another store; any other view stays as it is.
  ByteView moved(ByteView view, const MacroStore& from) const;

  /// Takes a user macro: false when the id is taken, or the heap or the index is full.
  bool save_user(std::uint8_t id, ByteView image);
  void forget_users();

  /// Empties the buffer that the temporary and the stream macro share.
  void clear_buffer();
  /// The temporary macro stays, but the next append_temporary() replaces it.
  void close_temporary() { closed_ = true; }
  /// Adds bytes to the temporary macro, whose id becomes 255 whatever it was: false, and nothing
  /// stored, when they do not fit.
  bool append_temporary(ByteView bytes);

  /// Adds a chunk of commands to the stream, of whose bytes those before `live_from` are done with.
  /// Returns by how much the rest moved down to make room; nothing when there still is none.
  std::optional<std::uint32_t> append_stream(ByteView commands, std::uint32_t live_from);
  ByteView stream() const { return ByteView(buffer_).first(buffer_used_); }

private:
  struct Entry {
    std::uint8_t id = spec::macro_id_none;
    std::uint16_t offset = 0;
    std::uint16_t size = 0;
  };

  std::array<std::uint8_t, spec::macro_buffer_size> buffer_{};
  std::size_t buffer_used_ = 0;
  bool holds_stream_ = false;
  bool closed_ = false;
  std::array<std::uint8_t, spec::macro_heap_size> heap_{};
  std::size_t heap_used_ = 0;
  std::array<Entry, spec::macro_heap_entries> entries_{};
  std::size_t entry_count_ = 0;
};

} // namespace orb::vm
