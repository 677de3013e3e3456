// Targets for hostile input. Each target takes any bytes at all and throws BrokenInvariant if the program
// would break its rules; a crash, a leak, undefined behaviour, a hang or memory over the bound is found by
// the runner: libFuzzer with the sanitizers (tests/fuzz/run.sh), or an ordinary test with the seeds.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

namespace osteomill::fuzz {

using Bytes = std::span<const std::uint8_t>;

struct BrokenInvariant : std::logic_error {
    using std::logic_error::logic_error;
};

inline void require(bool holds, const std::string& what) {
    if (!holds) throw BrokenInvariant(what);
}

/// Finding: frames that depend on the pieces in which the stream arrived, that do not encode to the bytes
/// that they came from, or that are longer than allowed; a complaint that is not one line.
void frame_decoder(Bytes input);

/// A client's messages, against ClientConnection, OutgoingFrames and ToolLease. Finding: a bone changed by a
/// client; a tool moved to a place without numbers; an answer that is no frame, or more frames than the
/// client may cause; a client dropped without a line.
void server_session(Bytes input);

/// A server's messages, against the decoder, SessionReceiver and VerifiedReplica. Finding: a copy with bone
/// outside its grid, a checksum that is not that of its voxels, dirty bricks that are not stored, a request
/// that a server would refuse.
void client_session(Bytes input);

/// A file, against Playhead. Finding: any exception but a RecordingError of one line; time that goes back; a
/// place gone back to that does not lead to the same bone.
void recording(Bytes input);

/// A file, against parse_scene. Finding: any exception but a SceneError of one line; a scene that does not
/// come back from write_scene as it was.
void scene(Bytes input);

/// The messages of Haply's service, against parse_haply_state. Finding: any exception; an arm or a grip at a
/// place without numbers; an arm of another name than was requested; a force for it that is no JSON.
void haply_state(Bytes input);

/// The first bytes of an image file, against our own readers of headers (GDCM never sees a file that these
/// refuse). Finding: any exception but an error of one line; voxels, files, sizes or a geometry beyond the
/// limits.
void nrrd_header(Bytes input);
void meta_image_header(Bytes input);
void nifti_header(Bytes input);
void dicom_header(Bytes input);

/// A segmentation that is well-formed DICOM, against the reader of DICOM SEG, and GDCM with it. Finding: any
/// exception but a complaint of one line; a geometry, layers, slices or labels beyond the limits.
void dicom_segmentation(Bytes input);

}  // namespace osteomill::fuzz
