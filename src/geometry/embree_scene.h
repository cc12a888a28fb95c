#pragma once
// Embree as all of Windfall uses it: trees over triangles and curves whose shape does not depend on the
// number of threads, and that leave TBB's threads to whoever asks them.
#include <embree3/rtcore.h>
#include <oneapi/tbb/task_arena.h>

namespace windfall::geometry {

/// A device, or null when Embree does not start. Not one of "threads=1": that holds all of TBB to one thread
/// for as long as the device lives.
inline RTCDevice new_embree_device() { return rtcNewDevice("set_affinity=0"); }

/// Builds a scene's tree, on one thread: with more, its shape, and with it ties between facets, would depend
/// on their number.
inline void commit_scene(RTCScene scene) {
    tbb::task_arena one_thread(1);
    one_thread.execute([scene] { rtcCommitScene(scene); });
}

}  // namespace windfall::geometry
