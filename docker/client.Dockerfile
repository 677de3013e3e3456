# render_client, drawing offscreen on the processor.
#   docker build -t osteomill-client -f docker/client.Dockerfile docker
# BASE: a Debian 12. PROGRAMS: an image with the programs, see programs.Dockerfile.
ARG BASE=debian:bookworm-slim
ARG PROGRAMS=osteomill-programs
FROM ${PROGRAMS} AS programs

FROM ${BASE}
RUN apt-get update -qq \
    && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
        fonts-dejavu-core libasound2 libegl1 libepoxy0 libfmt9 libgl1 libgl1-mesa-dri libglfw3 libopenal1 libpcap0.8 libpng16-16 libprotobuf32 \
        libspdlog1.10 libssl3 libstb0 libtomlplusplus3 libxxhash0 libzstd1 \
    && rm -rf /var/lib/apt/lists/* \
    && useradd --uid 10001 --create-home osteomill \
    && install -d -o osteomill /out
COPY --from=programs render_client /usr/local/bin/
# An image in which it lacks a library is none.
RUN render_client --version
COPY is_connected.sh /usr/local/bin/
USER osteomill
WORKDIR /out
HEALTHCHECK --interval=5s --timeout=3s --start-period=30s --retries=3 CMD is_connected.sh 7010
ENTRYPOINT ["render_client"]
CMD ["--connect", "server:7010", "--offscreen", "--frames", "100000", "--screenshots", "/out/frames"]
