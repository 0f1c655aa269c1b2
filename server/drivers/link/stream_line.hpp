/// \file
/// A line over any stream of Asio that carries bytes in both directions.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/write.hpp>

#include "server/drivers/link/line.hpp"

namespace seeker::drivers {

/// Reads and writes; what only a serial port can do is left to SerialLine. `Stream` is a serial port or a socket.
template <class Stream>
class StreamLine : public Line {
 public:
  /// `name` is what errors call the line.
  StreamLine(Stream stream, std::string name)
      : open_(std::make_shared<Open>(std::move(stream))), name_(std::move(name)) {}
  ~StreamLine() override {
    open_->closed = true;
    boost::system::error_code ignored;
    open_->stream.close(ignored);
  }

  void read(Received done) override {
    open_->stream.async_read_some(boost::asio::buffer(open_->chunk),
                                  [open = open_, name = name_, done = std::move(done)](
                                      const boost::system::error_code& error, std::size_t bytes) {
                                    if (open->closed) {
                                      return;
                                    }
                                    if (error) {
                                      done(lost(name, error));
                                    } else {
                                      done(std::span<const std::uint8_t>(open->chunk.data(), bytes));
                                    }
                                  });
  }

  void write(std::vector<std::uint8_t> bytes, Written done) override {
    open_->outgoing = std::move(bytes);
    boost::asio::async_write(open_->stream, boost::asio::buffer(open_->outgoing),
                             [open = open_, name = name_, done = std::move(done)](
                                 const boost::system::error_code& error, std::size_t /*bytes*/) {
                               if (!open->closed) {
                                 done(error ? Status(lost(name, error)) : Status());
                               }
                             });
  }

  [[nodiscard]] Status set_baud(std::uint32_t /*baud*/) override { return {}; }
  void set_dtr(bool /*on*/) override {}
  void drop_input() override {}

 protected:
  static tl::unexpected<Error> lost(const std::string& name, const boost::system::error_code& error) {
    const bool gone = error == boost::asio::error::eof || error == boost::asio::error::no_such_device;
    return fail(Errc::kLinkLost,
                name + (gone ? " was closed by the other side or unplugged" : " broke: " + error.message()) +
                    "; check the cable and the device's power");
  }
  [[nodiscard]] Stream& stream() { return open_->stream; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  /// What pending handlers hold on to.
  struct Open {
    explicit Open(Stream opened) : stream(std::move(opened)) {}
    Stream stream;
    std::array<std::uint8_t, 4096> chunk{};
    std::vector<std::uint8_t> outgoing;
    bool closed = false;
  };

  std::shared_ptr<Open> open_;
  std::string name_;
};

}  // namespace seeker::drivers
