// The job that a person means: by its id, or by its name where one job alone has it.
#pragma once

#include <string>

#include "client/farm_client.h"

namespace fjord {

// Its id. kNotFound where there is none; kInvalid, naming all of them, where several have the name.
Result<std::string> FindJob(FarmClient& client, const std::string& id_or_name);

}  // namespace fjord
