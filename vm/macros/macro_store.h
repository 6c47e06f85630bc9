#pragma once

#include "base/bytes.h"
#include "spec/macro.h"

#include <array>
#include <cstdint>
#include <optional>

namespace orb::vm {

/// Storage for macros: one buffer shared by the temporary and the stream macro, and a heap for user
/// macros with an index that is lost in sleep. A plain value. Source: low-level API §User Macros,
/// §The Stream Macro.
class MacroStore {
public:
  /// Returns the image (id, flags, body) of a user or temporary macro; empty if there is none.
  ByteView find(std::uint8_t id) const;

  /// Maps a view into `from` to the same bytes of this store. Other views stay as they are.
  ByteView moved(ByteView view, const MacroStore& from) const;

  /// Stores a user macro. Returns false if the id is taken, or the heap or index is full.
  bool save_user(std::uint8_t id, ByteView image);
  void forget_users();

  /// Empties the buffer shared by the temporary and the stream macro.
  void clear_buffer();
  /// Keeps the temporary macro, but lets the next append_temporary() replace it.
  void close_temporary() { closed_ = true; }
  /// Appends bytes to the temporary macro and sets its id to 255. Returns false and stores nothing
  /// if they do not fit.
  bool append_temporary(ByteView bytes);

  /// Appends a chunk of commands to the stream; bytes before `live_from` may be dropped. Returns
  /// how far the rest moved down to make room; nullopt if the chunk does not fit even so.
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
