// From a submit request to a job's description: the scene is read, its assets are looked for.
#pragma once

#include "fjord/v1/jobs.pb.h"
#include "server/blob_store.h"
#include "server/state/types.h"

namespace fjord::server {

// The request was validated. Reads the scene from the store: not for a message handler.
// Refused: scene or assets missing, not a scene, frames outside the animation.
Answer<JobSpec> ReadSubmission(const v1::SubmitRequest& request, BlobStore& blobs);

}  // namespace fjord::server
