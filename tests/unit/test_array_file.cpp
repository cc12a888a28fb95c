#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "core/error.h"
#include "take/array_file.h"

namespace windfall::take {
namespace {

using Bytes = std::vector<std::byte>;

ArrayFile sample_file() {
    ArrayFile file;
    file.meta = {{"kind", "sample"}, {"index", 3}};
    std::vector<float> wave(600);
    for (std::size_t i = 0; i < wave.size(); ++i) wave[i] = std::sin(0.1f * static_cast<float>(i));
    file.arrays.push_back({"skin/positions", {200, 3}, wave});
    file.arrays.push_back({"time", {2}, std::vector<double>{0.1, -1e300}});
    file.arrays.push_back({"faces", {1, 4}, std::vector<std::int32_t>{0, 1, 2, -1}});
    file.arrays.push_back({"state", {5}, std::vector<std::uint8_t>{1, 2, 3, 254, 255}});
    file.arrays.push_back({"nothing", {0, 3}, std::vector<float>{}});
    return file;
}

bool same(const ArrayFile& a, const ArrayFile& b) {
    if (a.meta != b.meta || a.arrays.size() != b.arrays.size()) return false;
    for (std::size_t i = 0; i < a.arrays.size(); ++i)
        if (a.arrays[i].name != b.arrays[i].name || a.arrays[i].shape != b.arrays[i].shape ||
            a.arrays[i].data != b.arrays[i].data)
            return false;
    return true;
}

std::string problem_of(const Bytes& bytes) {
    try {
        decode_array_file(bytes, "frame_0003.wfa");
    } catch (const InputError& problem) {
        return problem.what();
    }
    return "no error";
}

// A file with this header, sound but for what the header says.
Bytes forged(const std::string& header, const Bytes& blobs, std::uint32_t header_crc) {
    Bytes bytes = encode_array_file({});
    bytes.resize(12);
    const auto size = static_cast<std::uint32_t>(header.size());
    for (const auto number : {size, header_crc}) {
        const auto raw = std::as_bytes(std::span(&number, 1));
        bytes.insert(bytes.end(), raw.begin(), raw.end());
    }
    const auto text = std::as_bytes(std::span(header));
    bytes.insert(bytes.end(), text.begin(), text.end());
    bytes.insert(bytes.end(), blobs.begin(), blobs.end());
    return bytes;
}

// Bit by bit, so that the tests do not lean on the library that the code uses.
std::uint32_t plain_crc32(std::span<const std::byte> bytes) {
    std::uint32_t crc = 0xffffffffu;
    for (const auto byte : bytes) {
        crc ^= static_cast<std::uint32_t>(byte);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
    }
    return ~crc;
}

Bytes forged(const std::string& header, const Bytes& blobs) {
    return forged(header, blobs, plain_crc32(std::as_bytes(std::span(header))));
}

std::string header_of(const std::string& shape, std::size_t stored, std::uint32_t crc, int offset = 0) {
    return R"({"meta":{},"arrays":[{"name":"a","dtype":"f32","shape":)" + shape + R"(,"offset":)" +
           std::to_string(offset) + R"(,"stored_bytes":)" + std::to_string(stored) + R"(,"crc32":)" +
           std::to_string(crc) + "}]}";
}

// A zstd frame of `count` zero bytes in blocks of repeated bytes, without a checksum or a content size.
Bytes zeros_frame(std::size_t blocks) {
    std::vector<unsigned char> raw = {0x28, 0xb5, 0x2f, 0xfd, 0x00, 0x58};
    for (std::size_t b = 0; b < blocks; ++b) {
        const std::uint32_t head = (131072u << 3) | (1u << 1) | (b + 1 == blocks ? 1u : 0u);
        for (const unsigned shift : {0u, 8u, 16u}) raw.push_back(static_cast<unsigned char>(head >> shift));
        raw.push_back(0);
    }
    Bytes bytes(raw.size());
    std::memcpy(bytes.data(), raw.data(), raw.size());
    return bytes;
}

TEST(ArrayFile, ComesBackAsItWas) {
    const ArrayFile file = sample_file();
    EXPECT_TRUE(same(decode_array_file(encode_array_file(file), "x"), file));
}

TEST(ArrayFile, SameArraysGiveSameBytes) {
    const Bytes first = encode_array_file(sample_file());
    EXPECT_EQ(first, encode_array_file(sample_file()));
    ArrayFile other = sample_file();
    std::get<std::vector<float>>(other.arrays[0].data)[7] += 1e-6f;
    EXPECT_NE(first, encode_array_file(other));
}

TEST(ArrayFile, SmoothArraysShrink) {
    std::vector<float> wave(30000);
    for (std::size_t i = 0; i < wave.size(); ++i) wave[i] = std::sin(0.01f * static_cast<float>(i));
    ArrayFile file;
    file.arrays.push_back({"wave", {wave.size()}, wave});
    EXPECT_LT(encode_array_file(file).size(), wave.size() * sizeof(float) * 8 / 10);
}

TEST(ArrayFile, RefusesShapesThatDoNotFit) {
    ArrayFile file;
    file.arrays.push_back({"a", {2, 2}, std::vector<float>(5)});
    EXPECT_THROW(encode_array_file(file), std::logic_error);
    file.arrays = {{"a", {1}, std::vector<float>(1)}, {"a", {1}, std::vector<float>(1)}};
    EXPECT_THROW(encode_array_file(file), std::logic_error);
}

TEST(ArrayFile, RequiredArrayChecksTypeAndShape) {
    const ArrayFile file = sample_file();
    EXPECT_EQ(required_array<std::int32_t>(file, "faces", {0, 4}, "x").size(), 4u);
    EXPECT_THROW(required_array<float>(file, "absent", {0}, "x"), InputError);
    EXPECT_THROW(required_array<float>(file, "faces", {0, 4}, "x"), InputError);
    EXPECT_THROW(required_array<std::int32_t>(file, "faces", {0, 3}, "x"), InputError);
    EXPECT_THROW(required_array<std::int32_t>(file, "faces", {0}, "x"), InputError);
}

TEST(ArrayFile, EveryFlippedBitIsFound) {
    const Bytes sound = encode_array_file(sample_file());
    for (std::size_t i = 0; i < sound.size(); ++i) {
        Bytes bytes = sound;
        bytes[i] ^= static_cast<std::byte>(1u << (i % 8));
        EXPECT_THROW(decode_array_file(bytes, "x"), InputError) << "byte " << i;
    }
}

TEST(ArrayFile, EveryCutIsFound) {
    const Bytes sound = encode_array_file(sample_file());
    for (std::size_t size = 0; size < sound.size(); ++size)
        EXPECT_THROW(decode_array_file(std::span(sound).first(size), "x"), InputError) << size << " bytes";
    Bytes longer = sound;
    longer.push_back(std::byte{0});
    EXPECT_THROW(decode_array_file(longer, "x"), InputError);
}

// Behind a right checksum the header itself may say anything.
TEST(ArrayFile, ForgedHeadersDoNotCrash) {
    const Bytes sound = encode_array_file(sample_file());
    std::uint32_t header_bytes = 0;
    std::memcpy(&header_bytes, sound.data() + 12, 4);
    const std::string header(reinterpret_cast<const char*>(sound.data()) + 20, header_bytes);
    const Bytes blobs(sound.begin() + 20 + header_bytes, sound.end());
    ASSERT_TRUE(same(decode_array_file(forged(header, blobs), "x"), sample_file()));

    std::mt19937 random(1);
    const std::string alphabet = "0123456789-\"{}[],:e.atfnu";
    int refused = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        std::string text = header;
        for (unsigned k = 0, changes = 1 + random() % 3; k < changes; ++k)
            text[random() % text.size()] = alphabet[random() % alphabet.size()];
        try {
            decode_array_file(forged(text, blobs), "x");
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 10000);
}

TEST(ArrayFile, AbsurdLengthsAreRefusedAndCostNoMemory) {
    const Bytes blob = zeros_frame(1);
    const auto crc = plain_crc32(blob);
    ASSERT_EQ(problem_of(forged(header_of("[32768]", blob.size(), crc), blob)), "no error");
    // 4 GiB claimed, 128 KiB there: were it allocated at once, the sanitizers' limit and small machines would
    // tell.
    EXPECT_THAT(problem_of(forged(header_of("[1073741824]", blob.size(), crc), blob)),
                testing::HasSubstr("length of its shape"));
    EXPECT_THAT(problem_of(forged(header_of("[32767]", blob.size(), crc), blob)),
                testing::HasSubstr("length of its shape"));
    for (const char* shape :
         {"[4611686018427387904]", "[4294967296,4294967296]", "[18446744073709551615,2,0]"})
        EXPECT_THAT(problem_of(forged(header_of(shape, blob.size(), crc), blob)),
                    testing::HasSubstr("larger"));
    for (const char* shape : {"[-1]", "[1.5]", "\"x\"", "[1,1,1,1,1,1,1,1,1]", "null"})
        EXPECT_THAT(problem_of(forged(header_of(shape, blob.size(), crc), blob)), testing::HasSubstr("shape"))
            << shape;
    EXPECT_THAT(problem_of(forged(header_of("[32768]", 1u << 30, crc), blob)), testing::HasSubstr("cut off"));
    EXPECT_THAT(problem_of(forged(header_of("[32768]", blob.size(), crc, 1), blob)),
                testing::HasSubstr("follow"));
    EXPECT_THAT(problem_of(forged(header_of("[32768]", blob.size(), crc + 1), blob)),
                testing::HasSubstr("checksum"));
}

TEST(ArrayFile, DeepNestingDoesNotOverflowTheStack) {
    const std::string deep =
        "{\"meta\":{\"a\":" + std::string(2000000, '[') + std::string(2000000, ']') + "},\"arrays\":[]}";
    EXPECT_EQ(problem_of(forged(deep, {})), "no error");
}

TEST(ArrayFile, MessagesNameTheFileAndTheProblem) {
    EXPECT_THAT(problem_of({}),
                testing::AllOf(testing::StartsWith("frame_0003.wfa: "), testing::HasSubstr("cut off")));
    EXPECT_THAT(problem_of(Bytes(100)), testing::HasSubstr("not a Windfall array file"));
    Bytes newer = encode_array_file(sample_file());
    newer[8] = std::byte{2};
    EXPECT_THAT(problem_of(newer), testing::HasSubstr("version 2"));
}

}  // namespace
}  // namespace windfall::take
