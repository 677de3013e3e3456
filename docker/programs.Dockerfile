# The programs alone, compiled: the images of server and client take theirs from here.
#   docker build -t osteomill-programs -f docker/programs.Dockerfile .
ARG BASE=debian:bookworm-slim
FROM ${BASE} AS compiled
WORKDIR /osteomill
COPY scripts/packages.txt scripts/
RUN apt-get update -qq \
    && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $(grep -v '^#' scripts/packages.txt)
COPY . .
RUN cmake --preset release -DOSTEOMILL_TESTS=OFF >/dev/null && cmake --build --preset release \
    && cmake --install build/release --prefix /programs --strip

FROM scratch
COPY --from=compiled /programs/bin/ /
