-- Lets Wireshark and tshark read recordings of Osteomill: each packet is one message of session.proto.
--   tshark -r FILE -X lua_script:proto/osteomill.lua -o 'uat:protobuf_search_paths:"PATH/TO/proto","TRUE"' -V
local frame = Proto("osteomill", "Osteomill frame")
local protobuf = Dissector.get("protobuf")

function frame.dissector(buffer, packet, tree)
    packet.private["pb_msg_type"] = "message,osteomill.v2.ServerFrame"
    protobuf:call(buffer, packet, tree)
end

DissectorTable.get("wtap_encap"):add(wtap.USER0, frame)
