#!/usr/bin/env bash
# A PostgreSQL server of one's own for tests, from Debian's package: all it has lies in one folder, and whoever runs the
# tests may do everything in it, as the role `saca`, without a password. As root, it runs as the user `nobody`.
# usage: postgres_server.sh start FOLDER [PORT]      makes what is not there, and waits until it answers; its socket is in
#                                                    FOLDER. PORT: also for TLS, on 127.0.0.1, with a certificate that
#                                                    FOLDER/root.crt signs
#        postgres_server.sh replica FOLDER PRIMARY   a server that follows PRIMARY (another FOLDER) and may only be read
#        postgres_server.sh stop|kill FOLDER         stop: as soon as may be; kill: as if the power were lost
# Ends with 77 where PostgreSQL is not installed.
set -euo pipefail
what=$1
folder=$(realpath -m "$2")
bin=$(find /usr/lib/postgresql -maxdepth 2 -name bin 2>/dev/null | sort -V | tail -1)
[ -x "$bin/initdb" ] || exit 77

as_user=()
[ "$(id -u)" -ne 0 ] || as_user=(setpriv --reuid=nobody --regid=nogroup --clear-groups)

own() {  # makes the folder, for the user that the server runs as
  mkdir -p "$folder"
  [ "$(id -u)" -ne 0 ] || chown nobody:nogroup "$folder"
}

run() {
  (cd "$folder" && "${as_user[@]}" "$bin/pg_ctl" --pgdata="$folder/data" --log="$folder/log" --wait --silent start)
}

make_certificates() {
  openssl req -x509 -newkey rsa:2048 -nodes -days 2 -subj /CN=root -keyout "$folder/root.key" -out "$folder/root.crt" 2>/dev/null
  openssl req -newkey rsa:2048 -nodes -subj /CN=localhost -keyout "$folder/server.key" -out "$folder/server.csr" 2>/dev/null
  openssl x509 -req -days 2 -in "$folder/server.csr" -CA "$folder/root.crt" -CAkey "$folder/root.key" -CAcreateserial \
    -extfile <(echo subjectAltName=DNS:localhost) -out "$folder/server.crt" 2>/dev/null
  [ "$(id -u)" -ne 0 ] || chown nobody:nogroup "$folder"/server.*
  chmod 600 "$folder/server.key"
}

case $what in
  start)
    own
    if [ ! -d "$folder/data" ]; then
      "${as_user[@]}" "$bin/initdb" --pgdata="$folder/data" --username=saca --auth=trust --encoding=UTF8 --no-locale >/dev/null
      {
        echo "unix_socket_directories = '$folder'"
        echo "listen_addresses = ''"
        echo "shared_buffers = 16MB"
      } >> "$folder/data/postgresql.conf"
      if [ $# -gt 2 ]; then
        make_certificates
        {
          echo "listen_addresses = '127.0.0.1'"
          echo "port = $3"
          echo "ssl = on"
          echo "ssl_cert_file = '$folder/server.crt'"
          echo "ssl_key_file = '$folder/server.key'"
        } >> "$folder/data/postgresql.conf"
        echo "hostssl all all 127.0.0.1/32 scram-sha-256" > "$folder/data/pg_hba.conf"
        printf "local %s all trust\n" all replication >> "$folder/data/pg_hba.conf"
      fi
    fi
    run
    ;;
  replica)
    own
    primary=$(realpath "$3")
    port=$(sed -n 's/^port = //p' "$primary/data/postgresql.conf")
    (cd "$folder" && "${as_user[@]}" "$bin/pg_basebackup" --host="$primary" --port="${port:-5432}" --username=saca \
      --pgdata="$folder/data" --write-recovery-conf --checkpoint=fast)
    {
      echo "unix_socket_directories = '$folder'"
      echo "listen_addresses = ''"
      echo "wal_retrieve_retry_interval = 100ms"
    } >> "$folder/data/postgresql.conf"
    run
    ;;
  stop) (cd "$folder" && "${as_user[@]}" "$bin/pg_ctl" --pgdata="$folder/data" --mode=fast --silent stop) ;;
  kill) (cd "$folder" && "${as_user[@]}" "$bin/pg_ctl" --pgdata="$folder/data" --mode=immediate --silent stop) ;;
  *)
    echo "postgres_server: error: want start, replica, stop or kill, got $what" >&2
    exit 2
    ;;
esac
