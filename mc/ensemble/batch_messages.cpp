#include "mc/ensemble/batch_messages.hpp"

#include <cstring>

namespace gearpod::mc {
namespace {

class Packer {
  public:
    template <class Type>
    void put(const Type& value) {
        static_assert(std::is_trivially_copyable_v<Type>);
        append(&value, sizeof value);
    }
    template <class List>
    void put_list(const List& list) {
        put(list.size());
        append(list.data(), list.size() * sizeof *list.data());
    }
    std::vector<std::byte> take() { return std::move(bytes_); }

  private:
    void append(const void* data, std::size_t size) {
        const auto* first = static_cast<const std::byte*>(data);
        bytes_.insert(bytes_.end(), first, first + size);
    }
    std::vector<std::byte> bytes_;
};

class Unpacker {
  public:
    explicit Unpacker(std::span<const std::byte> bytes) : bytes_(bytes) {}
    template <class Type>
    Type get() {
        Type value{};
        copy(&value, sizeof value);
        return value;
    }
    template <class List>
    List get_list() {
        List list(get<std::size_t>(), typename List::value_type{});
        copy(list.data(), list.size() * sizeof *list.data());
        return list;
    }

  private:
    void copy(void* to, std::size_t size) {
        if (size > 0) {
            std::memcpy(to, bytes_.first(size).data(), size);
            bytes_ = bytes_.subspan(size);
        }
    }
    std::span<const std::byte> bytes_;
};

}  // namespace

std::vector<std::byte> bytes_of_number(std::size_t number) {
    Packer packer;
    packer.put(number);
    return packer.take();
}
std::size_t number_of(std::span<const std::byte> bytes) {
    return Unpacker(bytes).get<std::size_t>();
}

std::vector<std::byte> bytes_of_text(const std::string& text) {
    Packer packer;
    packer.put_list(text);
    return packer.take();
}
std::string text_of(std::span<const std::byte> bytes) {
    return Unpacker(bytes).get_list<std::string>();
}

std::vector<std::byte> bytes_of_batch(const FinishedBatch& batch) {
    Packer packer;
    packer.put(batch.batch);
    packer.put(batch.seconds);
    packer.put_list(batch.rows.status);
    packer.put_list(batch.rows.values);
    packer.put_list(batch.failure);
    packer.put(batch.stopped);
    return packer.take();
}
FinishedBatch batch_of(std::span<const std::byte> bytes) {
    Unpacker unpacker(bytes);
    FinishedBatch batch;
    batch.batch = unpacker.get<std::size_t>();
    batch.seconds = unpacker.get<double>();
    batch.rows.status = unpacker.get_list<std::vector<int>>();
    batch.rows.values = unpacker.get_list<std::vector<double>>();
    batch.failure = unpacker.get_list<std::string>();
    batch.stopped = unpacker.get<bool>();
    return batch;
}

std::vector<std::byte> bytes_of_times(const TeamTimes& times) {
    Packer packer;
    packer.put(times);
    return packer.take();
}
TeamTimes times_of(std::span<const std::byte> bytes) {
    return Unpacker(bytes).get<TeamTimes>();
}

}  // namespace gearpod::mc
