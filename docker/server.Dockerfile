# haptic_server and packet_replay, of the project's Debian packages: docker/build_images.sh
# BASE: the Debian that the packages are for.
ARG BASE=debian:trixie-slim
FROM ${BASE}
ARG DEBIAN_FRONTEND=noninteractive
COPY osteomill-server_*.deb osteomill-tools_*.deb /packages/
RUN apt-get update -qq \
    && apt-get install -y -qq --no-install-recommends libcap2-bin /packages/*.deb \
    && rm -rf /var/lib/apt/lists/* /packages \
    && useradd --uid 10001 --home-dir /tmp lab \
    && install -d -o lab /out
# A program that is granted what its container lacks does not start: see serve.sh.
RUN install -D /usr/bin/haptic_server /usr/local/lib/osteomill/haptic_server \
    && setcap cap_sys_nice+ep /usr/local/lib/osteomill/haptic_server
COPY serve.sh listens.sh /usr/local/bin/
USER lab
WORKDIR /out
EXPOSE 7010
HEALTHCHECK --interval=5s --timeout=3s --start-period=30s --retries=3 CMD listens.sh 7010
ENTRYPOINT ["serve.sh"]
# Its own loopback, for clients in the same network namespace. Other machines take TLS:
#   --listen 0.0.0.0:7010 --tls-cert F --tls-key F --tls-ca F, with the files in a volume, owned by user 10001
CMD ["--listen", "127.0.0.1:7010"]
