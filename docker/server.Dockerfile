# haptic_server and packet_replay, with what they need to run.
#   docker build -t osteomill-server -f docker/server.Dockerfile docker
# BASE: a Debian 12. PROGRAMS: an image with the programs, see programs.Dockerfile.
ARG BASE=debian:bookworm-slim
ARG PROGRAMS=osteomill-programs
FROM ${PROGRAMS} AS programs

FROM ${BASE}
RUN apt-get update -qq \
    && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
        libcap2-bin libfmt9 libgdcm3.0 libhdf5-103-1 libhidapi-hidraw0 libimath-3-1-29 libopenigtlink1.11 libopenvdb10.0 libpcap0.8 libpng16-16 libprotobuf32 libsndfile1 libspdlog1.10 libssl3 libtiff6 \
        libtbb12 libtomlplusplus3 libxxhash0 libzstd1 \
    && rm -rf /var/lib/apt/lists/* \
    && useradd --uid 10001 --create-home osteomill \
    && install -d -o osteomill /out
COPY --from=programs haptic_server packet_replay /usr/local/bin/
# An image in which they lack a library is none.
RUN haptic_server --version && packet_replay --version
# A program that is granted what its container lacks does not start: see serve.sh.
RUN install -D /usr/local/bin/haptic_server /usr/local/lib/osteomill/haptic_server \
    && setcap cap_sys_nice+ep /usr/local/lib/osteomill/haptic_server
COPY serve.sh listens.sh /usr/local/bin/
USER osteomill
WORKDIR /out
EXPOSE 7010
HEALTHCHECK --interval=5s --timeout=3s --start-period=30s --retries=3 CMD listens.sh 7010
ENTRYPOINT ["serve.sh"]
# Its own loopback, for clients in the same network namespace. Other machines take TLS:
#   --listen 0.0.0.0:7010 --tls-cert F --tls-key F --tls-ca F, with the files in a volume, owned by user 10001
CMD ["--listen", "127.0.0.1:7010"]
