#pragma once

#include "base/bytes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace capture_bytes {

using orb::Bytes;
using orb::ByteView;

inline void le16(Bytes& out, std::uint32_t value) {
  out.push_back(static_cast<std::uint8_t>(value));
  out.push_back(static_cast<std::uint8_t>(value >> 8));
}
inline void le32(Bytes& out, std::uint32_t value) {
  le16(out, value);
  le16(out, value >> 16);
}
inline void add(Bytes& out, ByteView bytes) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}

/// C4:…:`robot`, last byte first.
inline void address(Bytes& out, std::uint8_t robot) {
  for (const std::uint8_t byte : {robot, std::uint8_t{0x22}, std::uint8_t{0x11}, std::uint8_t{0x00},
                                  std::uint8_t{0xE7}, std::uint8_t{0xC4}})
    out.push_back(byte);
}

inline constexpr std::uint8_t command_type = 1;
inline constexpr std::uint8_t acl_type = 2;
inline constexpr std::uint8_t event_type = 4;

/// Computed bit by bit, as in 3GPP TS 07.10.
inline std::uint8_t rfcomm_check(ByteView bytes) {
  std::uint8_t check = 0xFF;
  for (const auto byte : bytes)
    for (int bit = 0; bit < 8; ++bit) {
      const bool one = ((check ^ (byte >> bit)) & 1) != 0;
      check = static_cast<std::uint8_t>(check >> 1);
      if (one)
        check ^= 0xE0;
    }
  return static_cast<std::uint8_t>(~check);
}

} // namespace capture_bytes

/// Writes Bluetooth captures as other programs do: a file in one of the formats, with the HCI
/// packets of a conversation.
class CaptureWriter {
public:
  enum class Format : std::uint8_t {
    Btsnoop,        ///< of Android: H4
    BtsnoopH1,      ///< … without types
    BtsnoopMonitor, ///< of `btmon -w`
    Pcap,           ///< H4 with directions
    PcapH4,         ///< H4 alone, in the other byte order
    Pcapng,         ///< H4 with directions
    PcapngMonitor,  ///< of the Linux monitor, with time stamps of nanoseconds
  };

  explicit CaptureWriter(Format format) : format_(format) { begin(); }

  /// Sets the time of the next packets.
  void at_ms(std::uint64_t ms) { ms_ = ms; }

  /// Adds a robot that advertises its name; its address ends in `robot`.
  void advertise(std::uint8_t robot, std::string_view name);
  /// Connects the computer to a robot under a handle, over classic Bluetooth or LE.
  void connect(std::uint16_t handle, std::uint8_t robot);
  void connect_classic(std::uint16_t handle, std::uint8_t robot);
  void disconnect(std::uint16_t handle);

  /// Adds the answer to a discovery: the attribute has this UUID.
  void discover(std::uint16_t handle, std::uint16_t attribute, std::string_view uuid);
  void write(std::uint16_t handle, std::uint16_t attribute, orb::ByteView bytes);
  void notify(std::uint16_t handle, std::uint16_t attribute, orb::ByteView bytes);
  /// Adds RFCOMM data to or from the robot.
  void send_serial(std::uint16_t handle, orb::ByteView bytes) { serial(handle, bytes, true); }
  void hear_serial(std::uint16_t handle, orb::ByteView bytes) { serial(handle, bytes, false); }

  /// Splits later L2CAP packets into pieces of this many bytes.
  void cut_into(std::size_t piece) { piece_ = piece; }

  const orb::Bytes& file() const { return file_; }

private:
  void begin();
  void frame(std::uint8_t type, bool sent, orb::ByteView bytes);
  void event(std::uint8_t code, const orb::Bytes& body);
  void l2cap(std::uint16_t handle, bool sent, std::uint16_t channel, const orb::Bytes& bytes);
  void serial(std::uint16_t handle, orb::ByteView bytes, bool sent);

  Format format_;
  std::uint64_t ms_ = 0;
  std::size_t piece_ = 27; // as much as the first Bluetooth LE controllers take
  orb::Bytes file_;
};

inline void CaptureWriter::begin() {
  switch (format_) {
  case Format::Btsnoop:
  case Format::BtsnoopH1:
  case Format::BtsnoopMonitor:
    capture_bytes::add(file_, orb::as_bytes(std::string_view("btsnoop\0", 8)));
    orb::append_u32(file_, 1);
    orb::append_u32(file_, format_ == Format::Btsnoop     ? 1002
                           : format_ == Format::BtsnoopH1 ? 1001
                                                          : 2001);
    break;
  case Format::Pcap:
    capture_bytes::le32(file_, 0xA1B2C3D4);
    capture_bytes::le32(file_, 0x00040002);
    capture_bytes::le32(file_, 0);
    capture_bytes::le32(file_, 0);
    capture_bytes::le32(file_, 65535);
    capture_bytes::le32(file_, 201);
    break;
  case Format::PcapH4:
    for (const std::uint32_t word : {0xA1B2C3D4U, 0x00020004U, 0U, 0U, 65535U, 187U})
      orb::append_u32(file_, word);
    break;
  case Format::Pcapng:
  case Format::PcapngMonitor: {
    for (const std::uint32_t word :
         {0x0A0D0D0AU, 28U, 0x1A2B3C4DU, 1U, 0xFFFFFFFFU, 0xFFFFFFFFU, 28U})
      capture_bytes::le32(file_, word);
    const bool monitor = format_ == Format::PcapngMonitor;
    // Adds the option for the resolution of timestamps unless it is the default.
    const std::uint32_t size = monitor ? 28 : 20;
    for (const std::uint32_t word : {1U, size, monitor ? 254U : 201U, 0U})
      capture_bytes::le32(file_, word);
    if (monitor) {
      capture_bytes::le16(file_, 9);
      capture_bytes::le16(file_, 1);
      capture_bytes::le32(file_, 9);
    }
    capture_bytes::le32(file_, size);
    break;
  }
  }
}

inline void CaptureWriter::frame(std::uint8_t type, bool sent, orb::ByteView bytes) {
  orb::Bytes data;
  const std::uint16_t opcode = type == capture_bytes::command_type ? 2
                               : type == capture_bytes::event_type ? 3
                               : sent                              ? 4
                                                                   : 5;
  switch (format_) {
  case Format::Btsnoop:
  case Format::PcapH4: data = {type}; break;
  case Format::BtsnoopH1:
  case Format::BtsnoopMonitor: break;
  case Format::Pcap:
  case Format::Pcapng: data = {0, 0, 0, std::uint8_t(sent ? 0 : 1), type}; break;
  case Format::PcapngMonitor: data = {0, 0, 0, static_cast<std::uint8_t>(opcode)}; break;
  }
  capture_bytes::add(data, bytes);
  const auto size = static_cast<std::uint32_t>(data.size());
  const std::uint64_t day = 1'800'000'000; // seconds since 1970
  const auto micros = day * 1'000'000 + ms_ * 1000;
  switch (format_) {
  case Format::Btsnoop:
  case Format::BtsnoopH1:
  case Format::BtsnoopMonitor: {
    const bool is_data = type == capture_bytes::acl_type;
    const auto since_0 = micros + 0x00DCDDB30F2F8000;
    orb::append_u32(file_, size);
    orb::append_u32(file_, size);
    orb::append_u32(
        file_, format_ == Format::BtsnoopMonitor ? opcode : (sent ? 0U : 1U) | (is_data ? 0U : 2U));
    orb::append_u32(file_, 0);
    orb::append_u32(file_, static_cast<std::uint32_t>(since_0 >> 32));
    orb::append_u32(file_, static_cast<std::uint32_t>(since_0));
    capture_bytes::add(file_, data);
    break;
  }
  case Format::Pcap:
    for (const std::uint64_t word :
         {day + ms_ / 1000, ms_ % 1000 * 1000, std::uint64_t{size}, std::uint64_t{size}})
      capture_bytes::le32(file_, static_cast<std::uint32_t>(word));
    capture_bytes::add(file_, data);
    break;
  case Format::PcapH4:
    for (const std::uint64_t word :
         {day + ms_ / 1000, ms_ % 1000 * 1000, std::uint64_t{size}, std::uint64_t{size}})
      orb::append_u32(file_, static_cast<std::uint32_t>(word));
    capture_bytes::add(file_, data);
    break;
  case Format::Pcapng:
  case Format::PcapngMonitor: {
    const auto ticks = format_ == Format::Pcapng ? micros : micros * 1000;
    const auto padded = (size + 3) / 4 * 4;
    const std::uint32_t block = 32 + padded;
    for (const std::uint32_t word : {6U, block, 0U, static_cast<std::uint32_t>(ticks >> 32),
                                     static_cast<std::uint32_t>(ticks), size, size})
      capture_bytes::le32(file_, word);
    data.resize(padded);
    capture_bytes::add(file_, data);
    capture_bytes::le32(file_, block);
    break;
  }
  }
}

inline void CaptureWriter::event(std::uint8_t code, const orb::Bytes& body) {
  orb::Bytes bytes{code, static_cast<std::uint8_t>(body.size())};
  capture_bytes::add(bytes, body);
  frame(capture_bytes::event_type, false, bytes);
}

inline void CaptureWriter::advertise(std::uint8_t robot, std::string_view name) {
  orb::Bytes body{2, 1, 0, 1};
  capture_bytes::address(body, robot);
  body.push_back(static_cast<std::uint8_t>(name.size() + 2));
  body.push_back(static_cast<std::uint8_t>(name.size() + 1));
  body.push_back(9);
  capture_bytes::add(body, orb::as_bytes(name));
  body.push_back(0xC0); // signal strength
  event(0x3E, body);
}

inline void CaptureWriter::connect(std::uint16_t handle, std::uint8_t robot) {
  orb::Bytes body{1, 0};
  capture_bytes::le16(body, handle);
  body.push_back(0);
  body.push_back(1);
  capture_bytes::address(body, robot);
  body.resize(19);
  event(0x3E, body);
}

inline void CaptureWriter::connect_classic(std::uint16_t handle, std::uint8_t robot) {
  orb::Bytes body{0};
  capture_bytes::le16(body, handle);
  capture_bytes::address(body, robot);
  body.resize(11);
  event(3, body);
  // PSM 3 is RFCOMM: a channel is requested and granted.
  l2cap(handle, true, 1, {2, 1, 4, 0, 3, 0, 0x43, 0});
  l2cap(handle, false, 1, {3, 1, 8, 0, 0x41, 0, 0x43, 0, 0, 0, 0, 0});
}

inline void CaptureWriter::disconnect(std::uint16_t handle) {
  orb::Bytes body{0};
  capture_bytes::le16(body, handle);
  body.push_back(0x13);
  event(5, body);
}

inline void CaptureWriter::l2cap(std::uint16_t handle, bool sent, std::uint16_t channel,
                                 const orb::Bytes& bytes) {
  orb::Bytes whole;
  capture_bytes::le16(whole, static_cast<std::uint32_t>(bytes.size()));
  capture_bytes::le16(whole, channel);
  capture_bytes::add(whole, bytes);
  for (std::size_t at = 0; at < whole.size(); at += piece_) {
    const auto size = std::min(piece_, whole.size() - at);
    const std::uint32_t boundary = at > 0 ? 1 : sent ? 0 : 2;
    orb::Bytes acl;
    capture_bytes::le16(acl, handle | boundary << 12);
    capture_bytes::le16(acl, static_cast<std::uint32_t>(size));
    capture_bytes::add(acl, orb::ByteView(whole).subspan(at, size));
    frame(capture_bytes::acl_type, sent, acl);
  }
}

inline void CaptureWriter::discover(std::uint16_t handle, std::uint16_t attribute,
                                    std::string_view uuid) {
  orb::Bytes body{0x09, 21};
  capture_bytes::le16(body, static_cast<std::uint32_t>(attribute - 1));
  body.push_back(0x18); // write, notify
  capture_bytes::le16(body, attribute);
  orb::Bytes digits;
  std::string hex;
  for (const char c : uuid)
    if (c != '-')
      hex += c;
  digits = *orb::from_hex(hex);
  body.insert(body.end(), digits.rbegin(), digits.rend());
  l2cap(handle, false, 4, body);
}

inline void CaptureWriter::write(std::uint16_t handle, std::uint16_t attribute,
                                 orb::ByteView bytes) {
  orb::Bytes body{0x12};
  capture_bytes::le16(body, attribute);
  capture_bytes::add(body, bytes);
  l2cap(handle, true, 4, body);
}

inline void CaptureWriter::notify(std::uint16_t handle, std::uint16_t attribute,
                                  orb::ByteView bytes) {
  orb::Bytes body{0x1B};
  capture_bytes::le16(body, attribute);
  capture_bytes::add(body, bytes);
  l2cap(handle, false, 4, body);
}

inline void CaptureWriter::serial(std::uint16_t handle, orb::ByteView bytes, bool sent) {
  const std::uint8_t head = sent ? 0x0B : 0x09; // channel 1, and who speaks
  orb::Bytes body{head, 0xEF};
  const auto check = capture_bytes::rfcomm_check(body);
  constexpr std::size_t short_most = 127;
  if (bytes.size() <= short_most) {
    body.push_back(static_cast<std::uint8_t>(bytes.size() << 1 | 1));
  } else {
    body.push_back(static_cast<std::uint8_t>(bytes.size() << 1));
    body.push_back(static_cast<std::uint8_t>(bytes.size() >> 7));
  }
  capture_bytes::add(body, bytes);
  body.push_back(check);
  l2cap(handle, sent, sent ? 0x41 : 0x43, body);
}
