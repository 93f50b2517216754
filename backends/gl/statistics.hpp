// SPDX-License-Identifier: MIT
//
// What the driver counts while a pass is drawn: GL_ARB_pipeline_statistics_query, in the core since 4.6.
#pragma once

#include "backends/backend.hpp"
#include "backends/gl/objects.hpp"

#include <array>
#include <cstddef>

namespace shadowmath::backend::gl {

class Statistics {
public:
    explicit Statistics(Procs const& gl) : gl_(gl) {
        for (Query& query : queries_) query = make_query(gl);
    }

    void begin() const {
        for (std::size_t i = 0; i < counted.size(); ++i) gl_.BeginQuery(counted[i], queries_[i]);
    }

    [[nodiscard]] DriverCount end() const {
        for (GLenum const what : counted) gl_.EndQuery(what);
        std::array<GLuint64, counted.size()> n{};
        for (std::size_t i = 0; i < counted.size(); ++i) gl_.GetQueryObjectui64v(queries_[i], GL_QUERY_RESULT, &n[i]);
        return {n[0], n[1], n[2], n[3], n[4], n[5], n[6]};
    }

private:
    static constexpr std::array<GLenum, 7> counted{GL_VERTICES_SUBMITTED,
                                                   GL_PRIMITIVES_SUBMITTED,
                                                   GL_VERTEX_SHADER_INVOCATIONS,
                                                   GL_GEOMETRY_SHADER_INVOCATIONS,
                                                   GL_GEOMETRY_SHADER_PRIMITIVES_EMITTED,
                                                   GL_CLIPPING_INPUT_PRIMITIVES,
                                                   GL_CLIPPING_OUTPUT_PRIMITIVES};

    Procs const& gl_;
    std::array<Query, counted.size()> queries_;
};

}  // namespace shadowmath::backend::gl
