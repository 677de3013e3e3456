// A receiver that does as OpenIGTLinkIF of 3D Slicer does, with the library's own client: a thread reads and
// keeps the newest message of a type and name; import() applies what has come, parts of images to the volume
// that is there.
#pragma once

#include <openigtlink/igtlClientSocket.h>
#include <openigtlink/igtlImageMessage.h>
#include <openigtlink/igtlMessageHeader.h>
#include <openigtlink/igtlStringMessage.h>
#include <openigtlink/igtlTransformMessage.h>
#include <openigtlink/igtl_header.h>

#include <atomic>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace osteomill::testing {

class SlicerReceiver {
  public:
    explicit SlicerReceiver(int port) : socket_(igtl::ClientSocket::New()) {
        if (socket_->ConnectToServer("127.0.0.1", port) != 0) throw std::runtime_error("nobody listens");
        thread_ = std::thread([this] { read(); });
    }
    ~SlicerReceiver() {
        ends_ = true;
        socket_->CloseSocket();
        thread_.join();
    }
    SlicerReceiver(const SlicerReceiver&) = delete;
    SlicerReceiver& operator=(const SlicerReceiver&) = delete;

    /// Imports the messages that came since the last import. A part of an image of another size makes a new
    /// volume of the bytes 0xCD: the memory of Slicer's is not cleared.
    void import() {
        std::map<Key, std::vector<std::uint8_t>> come;
        {
            const std::scoped_lock lock(mutex_);
            come.swap(newest_);
        }
        for (const auto& [key, bytes] : come) {
            if (key.first == "IMAGE") apply(*unpacked<igtl::ImageMessage>(bytes));
            if (key.first == "STRING") texts[key.second] = unpacked<igtl::StringMessage>(bytes)->GetString();
            if (key.first == "TRANSFORM") {
                igtl::Matrix4x4 matrix;
                unpacked<igtl::TransformMessage>(bytes)->GetMatrix(matrix);
                origins_mm[key.second] = {matrix[0][3], matrix[1][3], matrix[2][3]};
            }
        }
    }
    void send_string(const std::string& name, const std::string& text) {
        const auto message = igtl::StringMessage::New();
        message->SetDeviceName(name.c_str());
        message->SetString(text.c_str());
        message->Pack();
        socket_->Send(message->GetPackPointer(), message->GetPackSize());
    }

    glm::ivec3 size{0};
    std::vector<std::uint8_t> volume{};  ///< x fastest
    std::map<std::string, std::string> texts{};
    std::map<std::string, glm::dvec3> origins_mm{};
    int parts = 0;  ///< parts of images, imported so far
    int wholes = 0;

  private:
    using Key = std::pair<std::string, std::string>;

    template <typename Message>
    static typename Message::Pointer unpacked(const std::vector<std::uint8_t>& bytes) {
        const auto header = header_of(bytes);
        const auto message = Message::New();
        message->SetMessageHeader(header);
        message->AllocatePack();
        std::memcpy(message->GetPackBodyPointer(), bytes.data() + header->GetPackSize(),
                    static_cast<std::size_t>(message->GetPackBodySize()));
        if ((message->Unpack(1) & igtl::MessageHeader::UNPACK_BODY) == 0)
            throw std::runtime_error("a damaged message");
        return message;
    }
    static igtl::MessageHeader::Pointer header_of(const std::vector<std::uint8_t>& bytes) {
        const auto header = igtl::MessageHeader::New();
        header->InitPack();
        std::memcpy(header->GetPackPointer(), bytes.data(), static_cast<std::size_t>(header->GetPackSize()));
        header->Unpack();
        return header;
    }

    void read() {
        const int header_bytes = IGTL_HEADER_SIZE;
        while (!ends_) {
            std::vector<std::uint8_t> bytes(static_cast<std::size_t>(header_bytes));
            if (socket_->Receive(bytes.data(), header_bytes) != header_bytes) return;
            const auto header = header_of(bytes);
            const int body_bytes = static_cast<int>(header->GetBodySizeToRead());
            bytes.resize(static_cast<std::size_t>(header_bytes + body_bytes));
            if (socket_->Receive(bytes.data() + header_bytes, body_bytes) != body_bytes) return;
            const std::scoped_lock lock(mutex_);
            newest_[{header->GetDeviceType(), header->GetDeviceName()}] = std::move(bytes);
        }
    }

    void apply(igtl::ImageMessage& image) {
        int whole[3], part[3], first[3];
        image.GetDimensions(whole);
        image.GetSubVolume(part, first);
        const glm::ivec3 image_size(whole[0], whole[1], whole[2]);
        const bool is_whole = glm::ivec3(part[0], part[1], part[2]) == image_size;
        ++(is_whole ? wholes : parts);
        if (image_size != size) {
            size = image_size;
            volume.assign(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                              static_cast<std::size_t>(size.z),
                          0xCD);
        }
        const auto* from = static_cast<const std::uint8_t*>(image.GetScalarPointer());
        for (int z = first[2]; z < first[2] + part[2]; ++z)
            for (int y = first[1]; y < first[1] + part[1]; ++y, from += part[0])
                std::memcpy(&volume[static_cast<std::size_t>(first[0] + size.x * (y + size.y * z))], from,
                            static_cast<std::size_t>(part[0]));
    }

    igtl::ClientSocket::Pointer socket_;
    std::mutex mutex_;
    std::map<Key, std::vector<std::uint8_t>> newest_;
    std::atomic<bool> ends_{false};
    std::thread thread_;
};

}  // namespace osteomill::testing
