# cmake -DFOLDERS=… -DOUT=… -P fingerprint.cmake: writes the source of sourceFingerprint(), a hash of all sources in the folders.
foreach(folder IN LISTS FOLDERS)
    file(GLOB_RECURSE sources ${folder}/*.cpp ${folder}/*.h)
    foreach(source IN LISTS sources)
        file(SHA256 ${source} hash)
        list(APPEND hashes ${hash})
    endforeach()
endforeach()
list(SORT hashes)
string(SHA256 fingerprint "${hashes}")
file(WRITE ${OUT} "#include \"calibration/sourceFingerprint.h\"

std::string_view faintline::sourceFingerprint()
{
    return \"${fingerprint}\";
}
")
